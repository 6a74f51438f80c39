// SPDX-License-Identifier: GPL-3.0-or-later
// Two sculptors do the same: one with the box tree, one that looks at every face. Drags, creations, removals, undo and
// redo are mixed; every result with its contacts, and every coordinate, has to be the same to the bit.
#include "sculpting/edits/random_edits.h"
#include "sculpting/motion/same_bits.h"

#include <haptic_sculpt/surface/broad_phase/Brute_force_broad_phase.h>

#include <boost/test/unit_test.hpp>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Drag = Drag_result<Mesh>;
using Edited = Edit_result<Mesh>;

bool same(const Edited& a, const Edited& b) {
  return a.vertex == b.vertex && a.refusal.has_value() == b.refusal.has_value() &&
         (!a.refusal || (a.refusal->reason == b.refusal->reason && a.refusal->elements == b.refusal->elements));
}

/// What was done, so that a run shows that it was worth something.
struct Tally {
  std::size_t steps = 0, drags = 0, blocked = 0, with_contacts = 0, edits = 0, done = 0, undone = 0, differing = 0;

  Tally& operator+=(const Tally& other) {
    steps += other.steps, drags += other.drags, blocked += other.blocked, with_contacts += other.with_contacts;
    edits += other.edits, done += other.done, undone += other.undone, differing += other.differing;
    return *this;
  }
};

/// The two sculptors with a mesh each.
class Twins {
public:
  /// \param forgets whether the second takes the vertex anew for every drag, so that neither checklist nor free ball
  /// outlives a motion; only the stop, which carries no contacts along, may be asked that
  Twins(const Mesh& mesh, const Sculptor_parameters& options, bool forgets, std::uint64_t seed)
    : a_(mesh), b_(mesh), tree_(a_, options), brute_force_(b_, options), forgets_(forgets), random_(seed) {}

  Tally run(std::size_t steps) {
    while (tally_.steps < steps && tally_.differing == 0) {
      if (random_() % 3 == 0)
        edit();
      else
        hold();
      if (random_() % 64 == 0)
        compare_meshes();
    }
    compare_meshes();
    return tally_;
  }

private:
  Mesh a_, b_;
  Sculptor<Mesh> tree_;
  Sculptor<Mesh, Brute_force_broad_phase<Mesh>> brute_force_;
  bool forgets_;
  Random random_;
  Tally tally_;

  double number() { return std::uniform_real_distribution<double>(-1, 1)(random_); }

  Vertex_index any_vertex() { return pick(a_.vertices(), a_.number_of_vertices(), random_); }

  void differ(const char* what) {
    ++tally_.differing;
    BOOST_TEST_MESSAGE("they differ at step " << tally_.steps << " in " << what);
  }

  /// Some drags of one vertex: short ones, long ones, onto other vertices, on along what stopped it.
  void hold() {
    const Vertex_index v = any_vertex();
    auto grab = tree_.grab(v);
    auto other = brute_force_.grab(v);
    const double size = random_() % 4 == 0 ? 1.5 : random_() % 2 == 0 ? 0.15 : 0.01;
    const meshes::Kernel::Vector_3 way(number(), number(), number());
    for (std::size_t i = 1 + random_() % 12; i > 0; --i, ++tally_.steps, ++tally_.drags) {
      const meshes::Kernel::Vector_3 aside(number(), number(), number());
      const Point_3 target = random_() % 16 == 0 ? a_.point(any_vertex()) : a_.point(v) + size * (way + 0.5 * aside);
      if (forgets_)
        other.release();
      const Drag first = grab.drag_to(target), second = other.drag_to(target);
      tally_.blocked += !first.reached;
      tally_.with_contacts += !first.contacts.empty();
      if (!same_bits(first, second) || (!forgets_ && first.work != second.work) || !same_bits(a_.point(v), b_.point(v)))
        return differ("a drag");
    }
  }

  void edit() {
    ++tally_.steps, ++tally_.edits;
    const auto compared = [&](const char* what, const Edited& first, const Edited& second) {
      tally_.done += static_cast<bool>(first);
      if (!same(first, second))
        differ(what);
    };
    switch (random_() % 6) {
    case 0: {
      const auto f = pick(a_.faces(), a_.number_of_faces(), random_);
      const Point_3 p =
          in_face(a_, f, 0.35 + 0.2 * number(), 0.3) + 0.02 * meshes::Kernel::Vector_3(number(), number(), number());
      return compared("a creation on a face", tree_.insert_on_face(f, p), brute_force_.insert_on_face(f, p));
    }
    case 1: {
      const auto e = pick(a_.edges(), a_.number_of_edges(), random_);
      const Point_3 p = CGAL::midpoint(a_.point(a_.vertex(e, 0)), a_.point(a_.vertex(e, 1)));
      return compared("a creation on an edge", tree_.insert_on_edge(e, p), brute_force_.insert_on_edge(e, p));
    }
    case 2: case 3: {
      const Vertex_index v = any_vertex();
      return compared("a removal", tree_.remove(v), brute_force_.remove(v));
    }
    default: {
      const bool back = random_() % 3 != 0;
      for (std::size_t i = 1 + random_() % 20; i > 0; --i, ++tally_.steps, ++tally_.undone)
        compared(back ? "undo" : "redo", back ? tree_.undo() : tree_.redo(),
                 back ? brute_force_.undo() : brute_force_.redo());
    }
    }
  }

  void compare_meshes() {
    if (!same_bits(a_, b_))
      differ("the mesh");
  }
};

/// One scene of many steps. Every fourth keeps a delta.
Tally run_scene(std::uint64_t seed, std::size_t steps) {
  Random random(seed);
  const Response response = random() % 3 == 0 ? Response::stop : Response::slide;
  Sculptor_parameters options = parameters::response(response);
  if (random() % 4 == 0)
    options.delta(1e-4);
  const auto list = [&] {
    switch (random() % 6) {
    case 0: return meshes::icosphere(2);
    case 1: return meshes::box(3);
    case 2: return meshes::torus(14, 8);
    case 3: return meshes::row_of_spheres(3);
    case 4: return meshes::ball_in_a_cavity(1);
    default: return meshes::bipyramid(40);
    }
  }();
  return Twins(meshes::to_mesh(list), options, response == Response::stop, random()).run(steps);
}

} // namespace

BOOST_AUTO_TEST_CASE(the_box_tree_gives_what_brute_force_gives) {
  const std::uint64_t seed = seed_from_environment(62);
  const std::size_t steps = count_from_environment("HAPTIC_SCULPT_STEPS", 6000);
  Tally all;
  for (std::uint64_t scene = 0; all.steps < steps; ++scene) {
    const Tally tally = run_scene(seed + scene, std::min<std::size_t>(steps - all.steps, steps < 100000 ? 500 : 2000));
    all += tally;
    BOOST_REQUIRE_MESSAGE(tally.differing == 0, "scene of seed " << seed + scene);
  }
  BOOST_TEST_MESSAGE(all.steps << " steps: " << all.drags << " drags, of which " << all.blocked << " blocked and "
                               << all.with_contacts << " with contacts; " << all.edits << " edits, " << all.undone
                               << " undone or redone, " << all.done << " of both done; " << all.differing << " differ");
  BOOST_TEST(all.blocked > all.drags / 20);
  BOOST_TEST(all.with_contacts > all.drags / 20);
  BOOST_TEST(all.done > all.steps / 20);
}
