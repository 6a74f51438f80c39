// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest points and distances that are known beforehand.
#include <haptic_sculpt/surface/repair/distance_to_surface.h>

#include <boost/test/unit_test.hpp>

#include <array>

using haptic_sculpt::Decision_kernel;
using haptic_sculpt::internal::farthest_from_surface;
using haptic_sculpt::internal::Nearest_point_of_triangle;
using Point_3 = Decision_kernel::Point_3;
using Triangle_3 = Decision_kernel::Triangle_3;

BOOST_AUTO_TEST_CASE(nearest_inside_at_an_edge_at_a_corner) {
  const Nearest_point_of_triangle<Decision_kernel> nearest{};
  const Triangle_3 triangle(Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0));
  BOOST_TEST(nearest(triangle, Point_3(0.25, 0.25, 0.5)) == Point_3(0.25, 0.25, 0));
  BOOST_TEST(nearest(triangle, Point_3(0.5, -0.5, 0.5)) == Point_3(0.5, 0, 0));
  BOOST_TEST(nearest(triangle, Point_3(0.75, 0.75, 1)) == Point_3(0.5, 0.5, 0));
  BOOST_TEST(nearest(triangle, Point_3(-1, -0.5, 1)) == Point_3(0, 0, 0));
}

// The square of the normal, and of its edges, is 0 as a double.
BOOST_AUTO_TEST_CASE(the_nearest_point_of_a_thin_triangle_is_a_number) {
  const Nearest_point_of_triangle<Decision_kernel> nearest{};
  const double w = 0x1p-600;
  const Triangle_3 thin(Point_3(0, 0, 0), Point_3(w, 0, 0), Point_3(0, w, 0));
  BOOST_TEST(nearest(thin, Point_3(1, 0, 0)) == Point_3(w, 0, 0));
}

// The surface is as wide as doubles go, and thin.
BOOST_AUTO_TEST_CASE(a_distance_from_a_surface_is_never_nan) {
  haptic_sculpt::Face_soup soup;
  soup.add_point(0, 0, 0);
  soup.add_point(0x1p-400, 0, 0);
  soup.add_point(0, 0x1p-400, 0);
  soup.add_point(0, 0, 0x1p1000);
  soup.add_face(std::array{0, 1, 2});
  soup.add_face(std::array{0, 1, 3});
  BOOST_TEST(farthest_from_surface({Point_3(3, 4, 0)}, soup) == 5);
  BOOST_TEST(farthest_from_surface({Point_3(0, 0, 0x1p999)}, soup) == 0); // on an edge of it
}
