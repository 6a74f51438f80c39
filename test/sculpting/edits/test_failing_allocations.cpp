// SPDX-License-Identifier: GPL-3.0-or-later
// Each allocation of each call fails in turn: everything is as it was then, or the Sculptor refuses all later calls for
// good.
#include "sculpting/Mesh_snapshot.h"
#include "sculpting/edits/calls_that_allocate.h"
#include "sculpting/edits/failing_allocations.h"

#include <haptic_sculpt/haptic_rendering/exchange/Scene_visitor.h>
#include <haptic_sculpt/sculpting/isotropic_remeshing.h>
#include <haptic_sculpt/sculpting/move_rigidly.h>
#include <haptic_sculpt/sculpting/paper_1997/Six_list_broad_phase.h>

#include <boost/test/unit_test.hpp>

#include <functional>
#include <map>
#include <tuple>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

/// A broad phase as users write one: it allocates in whatever it hears of, and has no room made for it.
template <class Mesh_>
class Allocating_broad_phase : public Brute_force_broad_phase<Mesh_> {
public:
  using Brute_force_broad_phase<Mesh_>::Brute_force_broad_phase;
  template <class Faces>
  void faces_moved(const Faces& faces) {
    told(faces);
  }
  template <class Faces>
  void faces_inserted(const Faces& faces) {
    told(faces);
  }
  template <class Faces>
  void faces_removed(const Faces& faces) {
    told(faces);
  }

private:
  std::vector<std::size_t> last_;

  template <class Faces>
  void told(const Faces& faces) {
    std::vector<std::size_t> now;
    for (const auto f : faces)
      now.push_back(f);
    last_ = now;
  }
};

struct Outcome {
  std::size_t tries = 0, as_it_was = 0, made = 0, refused = 0;
};

/// Whether every later call is refused by name.
template <class World>
bool is_refused_for_good(World& w) {
  const std::function<void()> calls[] = {[&] { w.sculptor.check_unchanged(); },
                                         [&] { w.sculptor.undo(); },
                                         [&] { w.sculptor.redo(); },
                                         [&] { w.sculptor.grab(Vertex_index(3)); },
                                         [&] { w.sculptor.flip(Mesh::Edge_index(1)); },
                                         [&] { w.sculptor.insert_on_face(Mesh::Face_index(1), Point_3(0, 0, 0)); },
                                         [&] { w.sculptor.insert_on_edge(Mesh::Edge_index(1), Point_3(0, 0, 0)); },
                                         [&] { w.sculptor.remove(Vertex_index(1)); },
                                         [&] { w.sculptor.collapse(Mesh::Halfedge_index(1)); },
                                         [&] { w.sculptor.move_if_free(Vertex_index(1), Point_3(0, 0, 0)); },
                                         [&] { w.sculptor.first_impact(Vertex_index(1), Point_3(0, 0, 0)); },
                                         [&] { w.sculptor.probe(Point_3(9, 0, 0)); },
                                         [&] { w.sculptor.nearest_vertex(Point_3(9, 0, 0), 1); },
                                         [&] { w.sculptor.first_hit(Point_3(9, 0, 0), Point_3(8, 0, 0)); },
                                         [&] { w.sculptor.release(); },
                                         [&] { w.sculptor.reserve(1, 1); },
                                         [&] { w.stroke.emplace(w.sculptor.stroke()); },
                                         [&] { w.sculptor.set_delta(0); },
                                         [&] { w.sculptor.set_drag_parameters(Drag_parameters()); },
                                         [&] { w.sculptor.drag(Vertex_index(1), Point_3(0, 0, 0)); },
                                         [&] { w.sculptor.set_history_limit({}); },
                                         [&] { w.sculptor.id(Vertex_index(1)); },
                                         [&] { w.sculptor.vertex(1); },
                                         [&] { w.sculptor.number_of_ids(); },
                                         [&] { w.sculptor.face_of(0, 1, 2); },
                                         [&] { w.sculptor.edge_of(0, 1); }};
  for (const auto& call : calls)
    try {
      call();
      return false;
    } catch (const Unfinished_change&) {
    }
  return true;
}

template <class World>
Outcome try_case(const Case<World>& c, const Mesh& original, const Sculptor_parameters& parameters) {
  Outcome outcome;
  for (const bool for_good : {false, true}) {
    bool has_failed = true;
    for (std::size_t n = 1; has_failed; ++n) {
      World w(original, parameters);
      const Mesh_snapshot begin = snapshot(w.sculptor);
      c.prepare(w);
      const Mesh_snapshot before = snapshot(w.sculptor);
      const auto history = [history = w.sculptor.history()] {
        return std::tuple(history.number_of_undo_steps(), history.number_of_redo_steps(), history.is_in_stroke());
      };
      const auto history_before = history();
      has_failed = false;
      try {
        const Failing_allocations failing(n, for_good);
        c.act(w);
      } catch (const std::bad_alloc&) {
        has_failed = true;
      }
      if (!has_failed)
        continue;
      ++outcome.tries;
      try {
        w.sculptor.check_unchanged();
      } catch (const Unfinished_change&) {
        ++outcome.refused;
        BOOST_TEST(is_refused_for_good(w));
        continue;
      }
      const bool is_before = snapshot(w.sculptor) == before;
      ++(is_before ? outcome.as_it_was : outcome.made);
      BOOST_TEST((is_before || c.is_compound));
      if (is_before)
        BOOST_TEST((history() == history_before));
      BOOST_TEST(w.mesh.is_valid(false));
      // It works on, as if nothing had been, and all is undone to the bit.
      if (!c.is_compound)
        c.act(w);
      Random random(n);
      for (int i = 0; i < 12; ++i)
        random_edit(w.sculptor, random);
      w.sculptor.check_unchanged();
      BOOST_TEST(validate(w.mesh).is_valid());
      while (w.sculptor.undo())
        ;
      BOOST_TEST((snapshot(w.sculptor) == begin));
    }
  }
  return outcome;
}

template <class Broad_phase>
void try_all(const char* broad_phase, bool is_ready, const Sculptor_parameters& parameters, const Mesh& original) {
  using W = World<Broad_phase>;
  std::map<std::string, Outcome> outcomes;
  for (const Case<W>& c : calls_that_allocate<W>()) {
    BOOST_TEST_INFO_SCOPE(broad_phase << ", " << c.name);
    const Outcome outcome = try_case(c, original, parameters);
    Outcome& sum = outcomes[c.name];
    sum.tries += outcome.tries, sum.as_it_was += outcome.as_it_was, sum.made += outcome.made,
        sum.refused += outcome.refused;
  }
  std::size_t tries = 0, refused = 0;
  for (const auto& [name, o] : outcomes) {
    BOOST_TEST_MESSAGE(broad_phase << ", " << name << ": " << o.tries << " failed allocations, " << o.as_it_was
                                   << " as it was, " << o.made << " made in part of several calls, " << o.refused
                                   << " refused for good");
    tries += o.tries, refused += o.refused;
  }
  BOOST_TEST_MESSAGE(broad_phase << ": " << tries << " failed allocations, " << refused << " refused for good");
  BOOST_TEST(tries > 500u);
  BOOST_TEST(outcomes["end of a grab"].tries == 0u); // a destructor that allocates nothing
  if (is_ready)
    BOOST_TEST(refused == 0u);
  else
    BOOST_TEST(refused > 0u);
}

/// A sphere of 42 vertices.
Mesh scene() {
  return meshes::to_mesh(meshes::bumpy_sphere(1, 0.3, 0.05));
}

} // namespace

BOOST_AUTO_TEST_CASE(each_allocation_of_each_call_fails_in_turn) {
  try_all<Box_tree_broad_phase<Mesh>>("tree", true, {}, scene());
  try_all<Six_list_broad_phase<Mesh>>("six lists", true, parameters::response(Response::stop), scene());
  try_all<Brute_force_broad_phase<Mesh>>("brute force", true, {}, scene());
}

BOOST_AUTO_TEST_CASE(a_broad_phase_that_no_room_can_be_made_for) {
  try_all<Allocating_broad_phase<Mesh>>("of a user", false, {}, scene());
}

BOOST_AUTO_TEST_CASE(a_property_whose_values_allocate) {
  Mesh mesh = scene();
  mesh.add_property_map<Mesh::Face_index, std::string>("f:label", std::string(100, 'a'));
  try_all<Box_tree_broad_phase<Mesh>>("labelled faces", false, {}, mesh);
}

// An edit that an array of the mesh cannot grow for leaves the room that there was: what was done until then is undone.
BOOST_AUTO_TEST_CASE(where_no_array_grows_any_more_all_can_be_undone) {
  int ended = 0;
  for (std::size_t largest = 1u << 14; largest < 1u << 18; largest += largest / 7) {
    Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(3, 0.3, 0.05));
    Sculptor<Mesh> sculptor(mesh);
    sculptor.reserve(100, 8);
    const Mesh_snapshot begin = snapshot(sculptor);
    std::size_t steps = 0, undone = 0;
    try {
      const Failing_allocations failing(largest);
      try {
        for (Mesh::size_type f = 0; f < 1000; ++f) {
          const auto [a, b, c] = internal::corners_of_face(mesh, Mesh::Face_index(f));
          const Point_3 middle = CGAL::centroid(mesh.point(a), mesh.point(b), mesh.point(c));
          steps += static_cast<bool>(sculptor.insert_on_face(Mesh::Face_index(f), middle));
        }
      } catch (const std::bad_alloc&) {
        ++ended;
      }
      while (sculptor.undo())
        ++undone;
    } catch (const std::bad_alloc&) { // of an undo
    }
    BOOST_TEST(undone == steps, "requests of at most " << largest << " bytes: " << undone << " of " << steps);
    BOOST_TEST((snapshot(sculptor) == begin));
  }
  BOOST_TEST(ended > 10);
}

// Where there is no memory to remember which faces have changed, all have; and a copy under way stays right.
BOOST_AUTO_TEST_CASE(a_viewer_and_a_copy_have_all_though_no_memory_is_left_in_the_visitor) {
  using Faces = std::vector<std::array<std::uint32_t, 3>>;
  int all_marked = 0;
  for (std::size_t n = 1; n < 60; ++n) {
    Mesh mesh = scene();
    Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Scene_visitor<Mesh>> sculptor(mesh, {}, Scene_visitor<Mesh>(mesh));
    Scene_visitor<Mesh>& visitor = sculptor.visitor();
    visitor.mark_all(0); // and no room for more
    visitor.changed.clear();
    Scene_copy copy(10000, 20000);
    visitor.tell_to(&copy);
    copy.copy_some(sculptor, 100000);
    Faces seen(copy.faces);
    for (const std::uint32_t f : {5, 9}) {
      const Mesh::Halfedge_index h = mesh.halfedge(Mesh::Face_index(f));
      const Point_3 middle =
          CGAL::centroid(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))));
      try {
        const Failing_allocations failing(f == 5 ? n : 1000000, false);
        sculptor.insert_on_face(Mesh::Face_index(f), middle);
      } catch (const std::bad_alloc&) {
      }
      all_marked += visitor.changed.size() == mesh.number_of_faces();
    }
    for (; visitor.changed.size() != 0; visitor.changed.pop()) {
      const Mesh::Face_index f(visitor.changed.front());
      seen[f] = Scene_copy::corners_of(mesh, f);
    }
    BOOST_TEST((seen == copy.faces));
    for (const auto f : mesh.faces())
      BOOST_TEST((seen[f] == Scene_copy::corners_of(mesh, f)));
    visitor.tell_to(nullptr);
  }
  BOOST_TEST(all_marked > 0);
}

// Nor where all of memory is used up in the second axis of a step: what takes it back is there already.
BOOST_AUTO_TEST_CASE(an_object_is_where_it_was_or_has_arrived) {
  std::size_t tries = 0;
  for (const bool for_good : {false, true}) {
    bool has_failed = true;
    for (std::size_t n = 1; has_failed; ++n) {
      Mesh mesh = scene();
      const Mesh at_first = mesh;
      Sculptor<Mesh> sculptor(mesh);
      const std::vector<Vertex_index> all(mesh.vertices().begin(), mesh.vertices().end());
      const Vector_3 way(3, 5, 7);
      const CGAL::Aff_transformation_3<meshes::Kernel> translation(CGAL::TRANSLATION, way);
      has_failed = false;
      try {
        const Failing_allocations failing(n, for_good);
        move_rigidly(sculptor, all, translation);
      } catch (const std::bad_alloc&) {
        has_failed = true;
      }
      tries += has_failed;
      for (const Vertex_index v : all)
        BOOST_TEST((mesh.point(v) == (has_failed ? at_first.point(v) : translation.transform(at_first.point(v)))));
      BOOST_TEST(sculptor.history().number_of_undo_steps() == std::size_t{!has_failed});
      sculptor.check_unchanged();
      BOOST_TEST(move_rigidly(sculptor, all, translation).share == 1); // it works on
      BOOST_TEST(validate(mesh).is_valid());
    }
  }
  BOOST_TEST(tries > 40u);
}

// Constraints are handed on with each operation that stands: the edges of a cube that are constrained are those of its
// twelve sides, whole, whatever was split or drawn together by then.
BOOST_AUTO_TEST_CASE(constrained_edges_stay_constrained_where_a_remeshing_ends) {
  std::size_t tries = 0;
  bool has_failed = true;
  for (std::size_t n = 1; has_failed; n += 1 + n / 16) {
    Mesh mesh = meshes::to_mesh(meshes::box(2));
    auto is_constrained = mesh.add_property_map<Mesh::Edge_index, bool>("e:is_constrained", false).first;
    auto patch = mesh.add_property_map<Mesh::Face_index, int>("f:patch", -1).first;
    const auto side_of = [&](Mesh::Face_index f) { // by its normal, of length 1 along an axis
      const auto h = mesh.halfedge(f);
      const auto n =
          CGAL::normal(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))));
      for (int k = 0; k < 3; ++k)
        if (n[k] != 0)
          return 2 * k + (n[k] > 0);
      return -1;
    };
    for (const auto f : mesh.faces())
      patch[f] = side_of(f);
    const auto length_of_constrained = [&] {
      double sum = 0;
      for (const auto e : mesh.edges()) {
        const auto h = mesh.halfedge(e);
        if (is_constrained[e])
          sum += std::sqrt(CGAL::squared_distance(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))));
      }
      return sum;
    };
    for (const auto e : mesh.edges())
      is_constrained[e] = patch[mesh.face(mesh.halfedge(e))] != patch[mesh.face(mesh.opposite(mesh.halfedge(e)))];
    const double before = length_of_constrained();
    Sculptor<Mesh> sculptor(mesh);
    has_failed = false;
    try {
      const Failing_allocations failing(n, true);
      isotropic_remeshing(
          sculptor, 0.3,
          CGAL::parameters::edge_is_constrained_map(is_constrained).face_patch_map(patch).number_of_iterations(2));
    } catch (const std::bad_alloc&) {
      has_failed = true;
    }
    tries += has_failed;
    BOOST_TEST(std::fabs(length_of_constrained() - before) < 1e-12);
    for (const auto f : mesh.faces())
      BOOST_TEST(patch[f] == side_of(f));
  }
  BOOST_TEST(tries > 40u);
}

// A question that ends without memory has no half of an answer for the next one.
BOOST_AUTO_TEST_CASE(a_question_about_the_inside_that_failed_is_asked_again) {
  meshes::Triangle_list list = meshes::cube();
  meshes::Triangle_list turned = meshes::cube().scale_and_move(1, 3, 0, 0);
  for (auto& face : turned.faces)
    std::swap(face[0], face[1]);
  list += turned;
  std::size_t tries = 0;
  for (const bool is_looked_at_again : {false, true}) {
    bool has_failed = true;
    for (std::size_t n = 1; has_failed; ++n) {
      Mesh mesh = meshes::to_mesh(list);
      Sculptor<Mesh> sculptor(mesh);
      if (is_looked_at_again) {
        sculptor.is_inside_out(Vertex_index(0));
        for (int k = 0; k < 200; ++k)
          sculptor.insert_on_face(Mesh::Face_index(0), in_face(mesh, Mesh::Face_index(0), 0.3, 0.3));
      }
      has_failed = false;
      try {
        const Failing_allocations failing(n, false);
        sculptor.is_inside_out(Vertex_index(0));
      } catch (const std::bad_alloc&) {
        has_failed = true;
      }
      tries += has_failed;
      for (const Vertex_index v : mesh.vertices())
        BOOST_REQUIRE(sculptor.is_inside_out(v) == (mesh.point(v).x() > 2));
    }
  }
  BOOST_TEST(tries > 10u);
}
