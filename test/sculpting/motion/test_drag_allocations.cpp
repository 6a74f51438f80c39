// SPDX-License-Identifier: GPL-3.0-or-later
// Drags allocate nothing once they are warm: every operator new of this program is counted, and every request of GMP,
// to which exact decisions turn where coordinates are more than 2^199 apart.
#include "../examples/count_allocations.h"
#include "sculpting/Random_scene.h"

#include <haptic_sculpt/sculpting/paper_1997.h>

#include <boost/test/unit_test.hpp>

#include <gmp.h>

#include <cstdlib>
#include <optional>

namespace {
std::size_t gmp_allocations = 0; // of this program, so far

void* counted_by_gmp(std::size_t size) {
  ++gmp_allocations;
  return std::malloc(size);
}
void* resized_by_gmp(void* p, std::size_t, std::size_t size) {
  ++gmp_allocations;
  return std::realloc(p, size);
}
void freed_by_gmp(void* p, std::size_t) { std::free(p); }

struct Gmp_is_counted {
  Gmp_is_counted() { mp_set_memory_functions(counted_by_gmp, resized_by_gmp, freed_by_gmp); }
};
BOOST_TEST_GLOBAL_FIXTURE(Gmp_is_counted);
} // namespace

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Coordinates = std::array<double, 3>;

/// What one round of drags did.
struct Round {
  std::size_t allocations = 0, gmp_allocations = 0, drags = 0, blocked = 0, with_contacts = 0, with_many_contacts = 0,
              legs = 0;
};

/// The same targets every round: a tenth of an edge each way about where the vertex was first, pressed against what is
/// around it, along it, and pushed far through everything, inside one grab.
template <class Grab>
Round drag_about(Grab& grab, const Point_3& home, double edge, std::uint64_t seed) {
  using Vector_3 = meshes::Kernel::Vector_3;
  Random random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&](double length) {
    const double x = number(random), y = number(random), z = number(random);
    return Vector_3(length * x, length * y, length * z);
  };
  Round round;
  const auto drag = [&](const Point_3& target) {
    const std::size_t before = allocations_so_far, before_gmp = gmp_allocations;
    const auto result = grab.drag_to(target);
    if (result.contacts.size() <= Drag_result<Mesh>::usual_contacts)
      round.allocations += allocations_so_far - before;
    else
      ++round.with_many_contacts;
    round.gmp_allocations += gmp_allocations - before_gmp;
    ++round.drags;
    round.blocked += !result.reached;
    round.with_contacts += !result.contacts.empty();
    round.legs += static_cast<std::size_t>(result.legs);
    return result;
  };
  for (int i = 0; i < 40; ++i)
    drag(home + vector(0.1 * edge));
  for (int push = 0; push < 12; ++push) {
    const Vector_3 far = vector(30 * edge);
    const auto stopped = drag(home + far);
    // On, a little deeper than what stopped it each time, and across.
    Point_3 at = stopped.position;
    for (int i = 0; i < 20; ++i)
      at = drag(at + 0.002 * far + vector(0.1 * edge)).position;
    drag(home);
  }
  return round;
}

void check(const char* name, const meshes::Triangle_list& list, double edge, const Sculptor_parameters& options,
           std::uint64_t seed, bool is_extreme = false) {
  Mesh mesh = meshes::to_mesh(list);
  Sculptor<Mesh> sculptor(mesh, options);
  Random random(seed);
  std::size_t drags = 0, blocked = 0, with_contacts = 0, legs = 0, warm = 0, warm_gmp = 0, many = 0;
  const std::size_t grabs = count_from_environment("HAPTIC_SCULPT_WARM_GRABS", 12);
  for (std::size_t k = 0; k < grabs; ++k) {
    const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
    auto grab = sculptor.grab(v);
    const Point_3 home = mesh.point(v);
    const std::uint64_t targets = random();
    // Warms up: what was looked up is carried on, so that the same targets do not ask for the same again at once.
    drag_about(grab, home, edge, targets);
    for (int i = 0; i < 10 && drag_about(grab, home, edge, targets).allocations != 0; ++i)
      continue;
    drag_about(grab, home, edge, targets);
    for (int i = 0; i < 3; ++i) {
      const Round round = drag_about(grab, home, edge, targets);
      warm += round.allocations, warm_gmp += round.gmp_allocations, drags += round.drags, blocked += round.blocked;
      with_contacts += round.with_contacts, many += round.with_many_contacts, legs += round.legs;
    }
  }
  BOOST_TEST_MESSAGE(name << ", " << name_of(options.drag.response_rule) << ": " << drags << " drags, " << blocked
                          << " blocked, " << with_contacts << " with contacts (" << many << " with very many), " << legs
                          << " legs, " << warm << " allocations, " << warm_gmp << " of GMP");
  BOOST_TEST(warm == 0u);
  BOOST_TEST((share_of_sizes() < 1 || many < drags / 20));
  if (!is_extreme)
    BOOST_TEST(warm_gmp == 0u);
  BOOST_TEST(is_enough(blocked, drags / 50));
  BOOST_TEST(is_enough(with_contacts, drags / 50));
}

std::size_t largest_degree(const Mesh& mesh) {
  std::size_t largest = 0;
  for (const Vertex_index v : mesh.vertices())
    largest = std::max(largest, static_cast<std::size_t>(mesh.degree(v)));
  return largest;
}

} // namespace

BOOST_AUTO_TEST_CASE(warm_drags_allocate_nothing) {
  const std::uint64_t seed = seed_from_environment(6);
  BOOST_TEST(allocations_so_far > 0u); // it counts
  for (const Response response : {Response::slide, Response::stop, Response::paper()}) {
    const Sculptor_parameters options = parameters::response(response);
    check("torus", meshes::torus(40, 20), 0.15, options, seed);
    check("cube with flat sides", meshes::box(6).scale_and_move(1, 2, 3, 4), 1.0 / 6, options, seed + 1);
    // Coordinates of 0, and some that are 0 but for what many roundings left.
    check("cube around the origin", meshes::box(6), 1.0 / 6, options, seed + 1, true);
    check("ball in a cavity", meshes::ball_in_a_cavity(2), 0.3, options, seed + 2);
    check("bumpy sphere", meshes::bumpy_sphere(3, 0.2, 0.02), 0.15, options, seed + 3);
  }
}

// A vertex of hundreds of neighbours.
BOOST_AUTO_TEST_CASE(warm_drags_of_high_valence_allocate_nothing) {
  const std::uint64_t seed = seed_from_environment(6);
  for (const Response response : {Response::slide, Response::stop}) {
    Mesh mesh = meshes::to_mesh(meshes::bipyramid(300));
    Sculptor<Mesh> sculptor(mesh, parameters::response(response));
    auto grab = sculptor.grab(Vertex_index(300));
    const Point_3 home = mesh.point(Vertex_index(300));
    drag_about(grab, home, 0.2, seed);
    drag_about(grab, home, 0.2, seed);
    const Round round = drag_about(grab, home, 0.2, seed);
    BOOST_TEST_MESSAGE(round.drags << " drags, " << round.blocked << " blocked, " << round.with_many_contacts
                                   << " by very many contacts, " << round.allocations << " allocations, "
                                   << round.gmp_allocations << " of GMP");
    BOOST_TEST(round.allocations == 0u);
    BOOST_TEST(round.gmp_allocations == 0u);
    BOOST_TEST(round.blocked > 0u);
  }
}

// The room for undo is made when a vertex is taken: what is said of it there holds.
BOOST_AUTO_TEST_CASE(room_for_undo_is_made_at_the_grab) {
  Mesh mesh = meshes::to_mesh(meshes::torus(40, 20));
  Sculptor<Mesh> sculptor(mesh);
  auto grab = sculptor.grab(Vertex_index(7));
  const Point_3 home = mesh.point(Vertex_index(7));
  const auto there_and_back = [&](std::size_t drags) {
    for (std::size_t i = 0; i < drags; ++i)
      grab.drag_to(home + meshes::Kernel::Vector_3(0.001 * static_cast<double>(i % 7), 0, 0));
  };
  there_and_back(100);
  const std::size_t before = allocations_so_far;
  there_and_back(internal::Edit_history::room - 100);
  BOOST_TEST(allocations_so_far == before);
  BOOST_TEST(sculptor.history().number_of_undo_steps() > internal::Edit_history::room / 2);
}

// Creations, removals, collapses, flips, drags, undo, redo and strokes, from the first one on.
BOOST_AUTO_TEST_CASE(edits_allocate_nothing_after_reserve) {
  const std::uint64_t seed = seed_from_environment(7);
  constexpr std::size_t edits = 4000;
  for (const bool is_bounded : {false, true})
    for (const auto& list : {meshes::torus(40, 20), meshes::bumpy_sphere(3, 0.2, 0.02)}) {
      Mesh mesh = meshes::to_mesh(list);
      Sculptor<Mesh> sculptor(mesh);
      Random random(seed);
      if (is_bounded)
        sculptor.set_history_limit({100, std::size_t{1} << 20});
      sculptor.reserve(edits, edits);
      constexpr std::size_t usual_valence = 28; // for which reserve() makes room
      std::size_t before = 0, warm = 0, by_gmp = 0, unusual = 0;
      std::array<std::size_t, 8> done{}, allocated{};
      std::optional<Sculptor<Mesh>::Stroke_type> stroke;
      const auto any = [&](auto index, std::size_t slots) {
        do
          index = decltype(index)(static_cast<Mesh::size_type>(random() % slots));
        while (mesh.is_removed(index));
        return index;
      };
      for (std::size_t i = 0; i < edits; ++i) {
        const std::size_t kind = random() % 8;
        const Vertex_index v = any(Vertex_index(), mesh.num_vertices());
        const auto f = any(Mesh::Face_index(), mesh.num_faces());
        const auto e = any(Mesh::Edge_index(), mesh.num_edges());
        const auto h = mesh.halfedge(f);
        const Point_3 p = mesh.point(mesh.source(h)), q = mesh.point(mesh.target(h)),
                      r = mesh.point(mesh.target(mesh.next(h)));
        const Point_3 middle = CGAL::centroid(p, q, r),
                      half = CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)));
        const bool is_usual = mesh.degree(v) <= usual_valence && mesh.degree(mesh.source(h)) <= usual_valence;
        unusual += !is_usual;
        const bool is_all_usual = (kind != 5 && kind != 6) || largest_degree(mesh) <= usual_valence;
        const std::size_t before_gmp = gmp_allocations;
        before = allocations_so_far;
        if (random() % 16 == 0)
          stroke.reset(); // before another begins, or it would join
        if (random() % 32 == 0)
          stroke.emplace(sculptor.stroke());
        bool is_done = true;
        switch (kind) {
        case 0: is_done = static_cast<bool>(sculptor.insert_on_face(f, middle)); break;
        case 1: is_done = static_cast<bool>(sculptor.insert_on_edge(e, half)); break;
        case 2: is_done = static_cast<bool>(sculptor.remove(v)); break;
        case 3: is_done = static_cast<bool>(sculptor.collapse(h)); break;
        case 4: is_done = static_cast<bool>(sculptor.flip(e)); break;
        case 5: is_done = static_cast<bool>(sculptor.undo()); break;
        case 6: is_done = static_cast<bool>(sculptor.redo()); break;
        default: {
          const std::size_t before_drag = allocations_so_far;
          sculptor.grab(v).drag_to(mesh.point(v) + 0.1 * (middle - p));
          if (i < edits / 4) // until the lists of slides are warm
            before += allocations_so_far - before_drag;
        }
        }
        done[kind] += is_done;
        if (!is_usual || !is_all_usual) // undo and redo are where they are
          continue;
        allocated[kind] += allocations_so_far - before;
        warm += allocations_so_far - before;
        by_gmp += gmp_allocations - before_gmp;
      }
      BOOST_TEST_MESSAGE("done " << done[0] << " " << done[1] << " " << done[2] << " " << done[3] << " " << done[4]
                                 << " " << done[5] << " " << done[6] << ", allocations " << allocated[0] << " "
                                 << allocated[1] << " " << allocated[2] << " " << allocated[3] << " " << allocated[4]
                                 << " " << allocated[5] << " " << allocated[6] << " " << allocated[7] << ", of GMP "
                                 << by_gmp);
      BOOST_TEST(warm == 0u);
      BOOST_TEST(unusual < edits / 20);
      for (std::size_t kind = 0; kind < 7; ++kind)
        BOOST_TEST(done[kind] > 50u);
    }
}
