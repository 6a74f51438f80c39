// SPDX-License-Identifier: GPL-3.0-or-later
// The order in which many vertices go, against faces that are moved corner by corner in every order there is.
#include "sculpting/many_vertices/many_vertices_scene.h"

#include <haptic_sculpt/sculpting/move_vertices.h>

#include <algorithm>
#include <numeric>
#include <random>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

/// In the plane of a face that lies along the motion: how far along it, and how far across. Whole numbers.
struct Place {
  long along, across;
};

long twice_the_area(const std::array<Place, 3>& p) {
  return (p[1].along - p[0].along) * (p[2].across - p[0].across) -
         (p[2].along - p[0].along) * (p[1].across - p[0].across);
}

/// Moves the corners one after the other by `way`. While one moves the area changes linearly, so its sign need be looked
/// at before and after only. \return whether the face never turned over or became flat
bool stays_upright(std::array<Place, 3> p, const std::array<int, 3>& order, long way) {
  const bool is_positive = twice_the_area(p) > 0;
  for (const int i : order) {
    p[i].along += way;
    const long area = twice_the_area(p);
    if (area == 0 || (area > 0) != is_positive)
      return false;
  }
  return true;
}

/// Whether `order` has the corner first or last, as it is told to be.
bool keeps(const std::array<int, 3>& order, const internal::Corner_between& between) {
  return order[between.is_ahead ? 0 : 2] == between.corner;
}

} // namespace

BOOST_AUTO_TEST_CASE(the_corner_between_is_the_one_that_decides) {
  const unsigned seed = 5;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_int_distribution<long> coordinate(-6, 6), axis(0, 2);
  std::size_t faces = 0, ties = 0;
  while (faces < 20000) {
    const std::array<Place, 3> p = {Place{coordinate(random), coordinate(random)},
                                    Place{coordinate(random), coordinate(random)},
                                    Place{coordinate(random), coordinate(random)}};
    if (twice_the_area(p) == 0)
      continue;
    ++faces;
    const std::size_t x = static_cast<std::size_t>(axis(random)), y = (x + 1) % 3;
    std::array<internal::Coordinates, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i)
      corners[i][x] = static_cast<double>(p[i].along), corners[i][y] = static_cast<double>(p[i].across);
    internal::Vector d{};
    d[x] = 1;
    const auto between = internal::corner_between(corners, d);
    BOOST_TEST_REQUIRE(between.has_value());
    const bool is_tied = p[0].across == p[1].across || p[1].across == p[2].across || p[2].across == p[0].across;
    ties += is_tied;
    std::array<int, 3> order = {0, 1, 2};
    do {
      const bool is_upright = stays_upright(p, order, 1000);
      if (keeps(order, *between))
        BOOST_TEST(is_upright);
      else if (!is_tied) // where two are side by side the third may go when it likes
        BOOST_TEST(!is_upright);
    } while (std::next_permutation(order.begin(), order.end()));
  }
  BOOST_TEST(ties > 1000u);
}

BOOST_AUTO_TEST_CASE(a_face_across_the_motion_leaves_the_order_open) {
  const std::array<internal::Coordinates, 3> corners = {internal::Coordinates{0, 0, 0}, internal::Coordinates{1, 0, 0},
                                                        internal::Coordinates{0, 1, 0}};
  BOOST_TEST(!internal::corner_between(corners, {0, 0, 1}));
  BOOST_TEST(!internal::corner_between(corners, {0.5, 0, 1}));
  BOOST_TEST(internal::corner_between(corners, {1, 0, 0.5}).has_value());
  BOOST_TEST(!internal::corner_between(corners, {0, 0, 0}));
  BOOST_TEST(!internal::corner_between({corners[0], corners[0], corners[1]}, {0, 1, 0}));
}

BOOST_AUTO_TEST_CASE(each_vertex_has_its_turn_once) {
  for (const auto& [name, mesh] : scenes(false)) {
    std::vector<internal::Moving_vertex<Mesh>> moving;
    for (const Vertex_index v : mesh.vertices()) {
      const auto p = vertex_coordinates(mesh, v);
      moving.push_back({v, p, {-p[1], p[0], p[2]}});
    }
    auto order = internal::leaders_first(mesh, moving);
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> all(moving.size());
    std::iota(all.begin(), all.end(), 0u);
    BOOST_TEST((order == all), name);
  }
}

BOOST_AUTO_TEST_CASE(no_corner_turns_its_face_over_in_a_translation) {
  // In a box with coplanar faces, moved along them: each face that lies along the motion stays upright in its plane.
  const Mesh mesh = meshes::to_mesh(meshes::box(12));
  std::vector<internal::Moving_vertex<Mesh>> moving;
  for (const Vertex_index v : mesh.vertices()) {
    const auto p = vertex_coordinates(mesh, v);
    moving.push_back({v, p, {p[0] + 8, p[1], p[2]}});
  }
  const auto order = internal::leaders_first(mesh, moving);
  std::vector<std::size_t> turn(mesh.num_vertices());
  for (std::size_t i = 0; i < order.size(); ++i)
    turn[static_cast<std::size_t>(moving[order[i]].vertex)] = i;
  std::size_t faces = 0;
  for (const Face_index f : mesh.faces()) {
    std::array<internal::Coordinates, 3> corners;
    std::array<std::size_t, 3> turns;
    std::size_t i = 0;
    for (const Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f)))
      corners[i] = vertex_coordinates(mesh, v), turns[i++] = turn[static_cast<std::size_t>(v)];
    const auto between = internal::corner_between(corners, {8, 0, 0});
    if (!between)
      continue;
    ++faces;
    const std::size_t m = turns[between->corner], a = turns[(between->corner + 1) % 3],
                      b = turns[(between->corner + 2) % 3];
    BOOST_TEST((between->is_ahead ? m < std::min(a, b) : m > std::max(a, b)));
  }
  BOOST_TEST(faces > mesh.number_of_faces() / 2);
}
