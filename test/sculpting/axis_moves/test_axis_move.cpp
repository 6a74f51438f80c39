// SPDX-License-Identifier: GPL-3.0-or-later
// Motions of whole meshes along one axis against all pairs of faces, in integers, at many times of the motion.
// HAPTIC_SCULPT_AXIS_MOVES sets how many motions of small meshes are tried; see doc/use/testing.md.
#include "oracle/axis_oracle.h"
#include "sculpting/axis_moves/embedded_at.h"
#include "sculpting/motion/embedding_oracle_input.h"

#include <haptic_sculpt/sculpting/axis_moves/Axis_move.h>

#include <boost/test/unit_test.hpp>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;
using internal::Axis_obstacle;

namespace {

using Axis_move = internal::Axis_move<Mesh>;
using Ways = internal::Axis_ways<Mesh>;

/// Where it was and where it is to go, on the grid: a shift of one part, a shear, single vertices, or all at random.
std::vector<double> random_ends(Random& random, const oracle::Mesh_list& mesh, int axis, int size) {
  std::vector<double> ends;
  const int sort = static_cast<int>(random() % 5), other = (axis + 1 + static_cast<int>(random() % 2)) % 3;
  const double factor = static_cast<double>(random() % 5) - 2, limit = static_cast<double>(random() % 3) - 1;
  for (const auto& p : mesh.points) {
    const double noise = static_cast<double>(random() % (2 * size + 1)) - size;
    const double small = static_cast<double>(random() % 3) - 1;
    const bool is_chosen = random() % 3 == 0;
    ends.push_back(sort == 0   ? (is_chosen ? noise : p[axis])
                   : sort == 1 ? p[axis] + factor * p[other] + (is_chosen ? small : 0)
                   : sort == 2 ? (p[other] > limit ? p[axis] + factor : p[axis])
                   : sort == 3 ? p[axis] + small
                               : noise);
  }
  return ends;
}

Ways ways_of(const Axis_scene& scene) {
  Ways ways;
  for (std::size_t i = 0; i < scene.ends.size(); ++i)
    ways.push_back({Vertex_index(static_cast<Mesh::size_type>(i)), scene.ends[i]});
  return ways;
}

/// Whether what is named as an obstacle is one, by the oracle of the kernel.
bool is_obstacle(const Axis_scene& scene, const Axis_obstacle& obstacle) {
  Axis_query query{};
  query.axis = scene.axis;
  query.is_vertex_and_face = obstacle.kind == Axis_obstacle::Kind::vertex_face;
  for (int k = 0; k < 4; ++k) {
    const int from = obstacle.kind == Axis_obstacle::Kind::flat_face ? (k + 2) % 3 : k; // the oracle asks 1, 2, 3
    query.start[k] = scene.mesh.points[obstacle.vertices[from]];
    query.end[k] = scene.ends[obstacle.vertices[from]];
  }
  return obstacle.kind == Axis_obstacle::Kind::flat_face ? axis_face_degenerates(query) : axis_features_meet(query);
}

/// Two tetrahedra on the two sides of a plane along the axis, with an edge each in it, one farther along the axis: they
/// can meet in that plane only.
meshes::Triangle_list parts_at_a_vertical_plane(Random& random, int axis) {
  const auto side = static_cast<std::size_t>((axis + 1 + static_cast<int>(random() % 2)) % 3);
  const auto up = static_cast<std::size_t>(axis), along = 3 - up - side;
  for (;;) {
    meshes::Triangle_list list;
    for (const int part : {0, 1}) {
      std::array<std::array<double, 3>, 4> p{};
      for (std::size_t k = 0; k < 4; ++k) {
        p[k][side] = k < 2 ? 0 : (part == 0 ? -1 : 1) * static_cast<double>(1 + random() % 3);
        p[k][along] = static_cast<double>(random() % 5);
        p[k][up] = static_cast<double>(6 * part) + static_cast<double>(random() % 5);
      }
      std::array<std::size_t, 4> v{};
      for (std::size_t k = 0; k < 4; ++k)
        v[k] = list.add_point(p[k][0], p[k][1], p[k][2]);
      const auto& q = list.points;
      if (CGAL::orientation(q[v[0]], q[v[1]], q[v[2]], q[v[3]]) != CGAL::POSITIVE)
        std::swap(v[0], v[1]);
      list.add_face(v[0], v[2], v[1]), list.add_face(v[0], v[1], v[3]);
      list.add_face(v[0], v[3], v[2]), list.add_face(v[1], v[2], v[3]);
    }
    if (validate(meshes::to_mesh(list)).is_valid())
      return list;
  }
}

struct Small_motion {
  meshes::Triangle_list list;
  Axis_scene scene;
};

Small_motion random_motion(Random& random) {
  const int size = 1 + static_cast<int>(random() % 4);
  Small_motion motion;
  const int axis = static_cast<int>(random() % 3);
  const bool is_vertical = random() % 6 == 0;
  motion.list = is_vertical ? parts_at_a_vertical_plane(random, axis) : random_small_list(random, size + (size == 1));
  motion.scene = {to_oracle(motion.list), axis, {}};
  motion.scene.ends = random_ends(random, motion.scene.mesh, axis, size);
  if (is_vertical) { // the lower one goes up as a whole, or nearly so
    const double way = static_cast<double>(random() % 16);
    for (std::size_t i = 0; i < 8; ++i)
      motion.scene.ends[i] = motion.scene.mesh.points[i][axis] + (i < 4 ? way + static_cast<double>(random() % 2) : 0);
  }
  return motion;
}

/// Times at which to look: all that can matter for few vertices, else some at random.
std::vector<mpq_class> times_to_look(Random& random, const Axis_scene& scene) {
  std::vector<mpq_class> times{1};
  if (scene.mesh.points.size() <= 5) {
    times = times_in_one_plane(scene);
    std::sort(times.begin(), times.end());
    for (std::size_t i = times.size(); i-- > 1;)
      times.push_back((times[i] + times[i - 1]) / 2);
    return times;
  }
  for (int i = 0; i < 16; ++i) {
    const unsigned long whole = 1 + random() % 97, part = random() % (whole + 1);
    times.push_back(mpq_class(mpz_class(part), mpz_class(whole)));
    times.back().canonicalize();
  }
  return times;
}

} // namespace

BOOST_AUTO_TEST_CASE(free_motions_are_embedded_all_the_way) {
  Random random(seed_from_environment(1));
  const std::size_t motions = count_from_environment("HAPTIC_SCULPT_AXIS_MOVES", 3000);
  std::size_t free = 0, wrongly_free = 0, wrongly_named = 0, looks = 0;
  std::array<std::size_t, 3> obstacles{};
  for (std::size_t i = 0; i < motions; ++i) {
    const auto [list, scene] = random_motion(random);
    const Mesh mesh = meshes::to_mesh(list);
    Filter_counters counters;
    Axis_move move(mesh, counters);
    move.take({mesh.faces().begin(), mesh.faces().end()}, true);
    move.begin(scene.axis, ways_of(scene), 0);
    for (const Axis_obstacle& obstacle : move.sorted_obstacles()) {
      ++obstacles[static_cast<int>(obstacle.kind)];
      wrongly_named += !is_obstacle(scene, obstacle);
    }
    if (!move.is_free())
      continue;
    ++free;
    for (const mpq_class& t : times_to_look(random, scene)) {
      ++looks;
      if (!is_embedded_at(scene, t)) {
        ++wrongly_free;
        break;
      }
    }
  }
  BOOST_TEST_MESSAGE(motions << " motions, " << free << " free, looked at " << looks << " times; obstacles: "
                             << obstacles[0] << " vertex-face, " << obstacles[1] << " edge-edge, " << obstacles[2]
                             << " faces");
  BOOST_TEST(wrongly_free == 0u);
  BOOST_TEST(wrongly_named == 0u);
  BOOST_TEST(free > motions / 5);
  BOOST_TEST(free < motions * 4 / 5);
  for (const std::size_t count : obstacles)
    BOOST_TEST(count > motions / 50);
}

BOOST_AUTO_TEST_CASE(what_is_held_back_leaves_a_free_motion) {
  Random random(seed_from_environment(2));
  std::size_t wrong = 0, came_nearer = 0, motions = 0;
  while (motions < 500) {
    auto [list, scene] = random_motion(random);
    const Mesh mesh = meshes::to_mesh(list);
    Filter_counters counters;
    Axis_move move(mesh, counters);
    move.take({mesh.faces().begin(), mesh.faces().end()}, true);
    move.begin(scene.axis, ways_of(scene), 0);
    if (move.is_free())
      continue;
    ++motions;
    move.hold_back();
    bool is_nearer = false;
    for (std::size_t i = 0; i < scene.ends.size(); ++i) {
      const double start = scene.mesh.points[i][scene.axis], asked = scene.ends[i];
      scene.ends[i] = move.end(Vertex_index(static_cast<Mesh::size_type>(i)));
      is_nearer |= scene.ends[i] != start;
      wrong += !(std::min(start, asked) <= scene.ends[i] && scene.ends[i] <= std::max(start, asked));
    }
    came_nearer += is_nearer;
    for (const mpq_class& t : times_to_look(random, scene))
      wrong += !is_embedded_at(scene, t);
  }
  BOOST_TEST_MESSAGE(came_nearer << " of " << motions << " motions that were not free made in part");
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(came_nearer > motions / 2);
}

// A right angle is three shears, and each is free, for whatever is embedded.
BOOST_AUTO_TEST_CASE(shears_of_large_meshes_are_free) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(4, 0.3, 0.01));
  Filter_counters counters;
  Axis_move move(mesh, counters);
  move.take({mesh.faces().begin(), mesh.faces().end()}, true);
  for (const auto& [axis, other, factor] : {std::tuple<int, int, double>(0, 1, -1.0), {1, 0, 1.0}, {0, 1, -1.0}}) {
    Ways ways;
    for (const Vertex_index v : mesh.vertices())
      ways.push_back({v, mesh.point(v)[axis] + factor * mesh.point(v)[other]});
    move.begin(axis, ways, 0);
    BOOST_TEST(move.is_free());
    for (const auto& way : ways) {
      std::array<double, 3> p = vertex_coordinates(mesh, way.first);
      p[axis] = way.second;
      mesh.point(way.first) = Point_3(p[0], p[1], p[2]);
    }
    BOOST_TEST(validate(mesh).is_valid());
  }
}

BOOST_AUTO_TEST_CASE(noise_of_large_meshes_ends_valid) {
  Random random(seed_from_environment(3));
  for (const double size : {0.02, 0.2}) {
    Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(4, 0.3, 0.01));
    Filter_counters counters;
    Axis_move move(mesh, counters);
    move.take({mesh.faces().begin(), mesh.faces().end()}, true);
    for (int axis = 0; axis < 3; ++axis) {
      Ways ways;
      for (const Vertex_index v : mesh.vertices())
        ways.push_back({v, mesh.point(v)[axis] + size * (static_cast<double>(random() % 2001) / 1000 - 1)});
      move.begin(axis, ways, 0);
      move.hold_back();
      BOOST_TEST(move.is_free());
      std::size_t whole = 0;
      for (const auto& way : ways) {
        std::array<double, 3> p = vertex_coordinates(mesh, way.first);
        whole += move.end(way.first) == way.second;
        p[axis] = move.end(way.first);
        mesh.point(way.first) = Point_3(p[0], p[1], p[2]);
      }
      BOOST_TEST_MESSAGE("noise " << size << ", axis " << axis << ": " << whole << " of " << ways.size() << " whole");
      BOOST_TEST(validate(mesh).is_valid());
    }
  }
}
