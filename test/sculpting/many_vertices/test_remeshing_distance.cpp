// SPDX-License-Identifier: GPL-3.0-or-later
// Guarded remeshing of spikes and needles: no part of the input is left behind.
#include "meshes/spikes.h"
#include "sculpting/many_vertices/many_vertices_scene.h"

#include <haptic_sculpt/sculpting/isotropic_remeshing.h>

#include <CGAL/Polygon_mesh_processing/distance.h>

#include <algorithm>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

/// The largest distance of a vertex of the input to the result, by CGAL's search tree.
double farthest_vertex(const Mesh& input, Mesh result) {
  result.collect_garbage();
  std::vector<Point_3> points;
  for (const auto v : input.vertices())
    points.push_back(input.point(v));
  return CGAL::Polygon_mesh_processing::max_distance_to_triangle_mesh<CGAL::Sequential_tag>(points, result);
}

/// Of the squares, which are of numbers as large as the mesh: 2^-30 of a length is far more.
constexpr double with_rounding = 1 + 0x1p-30;

double remeshed_distance(const Mesh& input, double length, const Remeshing_parameters& parameters) {
  Mesh mesh = input;
  Sculptor<Mesh> sculptor(mesh);
  isotropic_remeshing(sculptor, length, CGAL::parameters::number_of_iterations(5), parameters);
  BOOST_TEST(validate(mesh).is_valid());
  return farthest_vertex(input, mesh) / length;
}

} // namespace

BOOST_AUTO_TEST_CASE(spikes_are_not_eaten) {
  // Cones with a base of half a length, four lengths high.
  double without_bound = 0;
  for (const double length : {0.3, 0.2}) {
    const Mesh input = meshes::to_mesh(meshes::ball_with_cones(length > 0.25 ? 4 : 5, length / 2, 4 * length));
    BOOST_TEST(remeshed_distance(input, length, {}) <= with_rounding);
    BOOST_TEST(remeshed_distance(input, length, Remeshing_parameters().max_distance(length / 4)) <= with_rounding / 4);
    const double infinity = std::numeric_limits<double>::infinity();
    without_bound =
        std::max(without_bound, remeshed_distance(input, length, Remeshing_parameters().max_distance(infinity)));
  }
  BOOST_TEST(without_bound > 1.1); // the test can fail: tips go, though which depends on rounding
}

BOOST_AUTO_TEST_CASE(no_input_vertex_is_left_behind) {
  std::vector<Named_mesh> meshes = scenes();
  meshes.push_back({"gear", meshes::to_mesh(meshes::gear(40, 4))});
  for (const auto& [name, input] : meshes)
    for (const double factor : {1.5, 4.0})
      for (const double share : {1.0, 0.3})
        BOOST_TEST_CONTEXT(name << " to " << factor << " mean edges, at most " << share) {
          const double length = factor * mean_edge(input);
          BOOST_TEST(remeshed_distance(input, length, Remeshing_parameters().max_distance(share * length)) <=
                     share * with_rounding);
        }
}

BOOST_AUTO_TEST_CASE(distances_to_triangles) {
  // Against the least of many points of the triangle, and the plane.
  std::mt19937 random(static_cast<std::uint32_t>(seed_from_environment(1)));
  const auto uniform = [&] { return random() / 2147483648.0 - 1; };
  for (int run = 0; run < 2000; ++run) {
    internal::Vector p, t[3];
    for (internal::Vector* q : {&p, &t[0], &t[1], &t[2]})
      *q = {uniform(), uniform(), uniform()};
    if (run % 4 == 0) // a needle
      t[2] = internal::quick_sum(internal::plus(t[0], internal::scaled(internal::minus(t[1], t[0]), 0.3)), 1e-9, t[2]);
    const double found = internal::squared_distance_to_triangle(p, t[0], t[1], t[2]);
    const auto point = [](const internal::Vector& q) { return Point_3(q[0], q[1], q[2]); };
    const meshes::Kernel::Triangle_3 triangle(point(t[0]), point(t[1]), point(t[2]));
    const double exact = CGAL::squared_distance(point(p), triangle);
    // Rounded on the safe side: a needle's nearest point may be taken beside the nearest.
    BOOST_TEST(found >= exact - 1e-12);
    BOOST_TEST(found <= exact + (run % 4 == 0 ? 1e-6 : 1e-12));
  }
  const internal::Vector a = {0, 0, 0}, b = {1, 0, 0}, c = {0, 1, 0};
  BOOST_TEST(internal::squared_distance_to_triangle({0.25, 0.25, 2}, a, b, c) == 4);
  BOOST_TEST(internal::squared_distance_to_triangle({-1, -1, 1}, a, b, c) == 3);
  BOOST_TEST(internal::squared_distance_to_triangle({1, 1, 0}, a, b, c) == 0.5);
  BOOST_TEST(internal::squared_distance_to_triangle({0.5, -2, 0}, a, b, c) == 4);
}
