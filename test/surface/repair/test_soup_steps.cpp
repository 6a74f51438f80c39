// SPDX-License-Identifier: GPL-3.0-or-later
// The steps of a repair that look at corners alone: what they count, and what keeps its attributes.
#include "surface/repair/count_of.h"
#include "surface/soup_of.h"

#include <boost/test/unit_test.hpp>

#include <array>

namespace {

using haptic_sculpt::Face_soup;
using haptic_sculpt::repair;
using haptic_sculpt::Repair_kind;
using haptic_sculpt::Repair_report;
using haptic_sculpt::validate_soup;
using haptic_sculpt::test::count_of;
using haptic_sculpt::test::soup_of;
using meshes::Point_3;
using meshes::Triangle_list;

} // namespace

BOOST_AUTO_TEST_SUITE(repairing)

// A polygon that meets itself in a corner is divided there, even where that is all there is to do.
BOOST_AUTO_TEST_CASE(a_repeated_corner_of_a_polygon_is_a_step) {
  Face_soup soup;
  for (int k = 0; k < 4; ++k)
    soup.add_point(k == 1, k == 2, k == 3);
  soup.add_face(std::array{0, 2, 1, 0}); // the corner 0 twice
  for (const auto& f : {std::array{0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
    soup.add_face(f);
  BOOST_TEST(!validate_soup(soup).is_valid());
  const Repair_report report = repair(soup);
  BOOST_TEST(report.is_repaired());
  BOOST_TEST(count_of(report, Repair_kind::drop_faces, "polygons with a repeated corner divided there") == 1u);
  BOOST_TEST(validate_soup(soup).is_valid());
}

// What is divided makes a face more, and a doubled one is a face less.
BOOST_AUTO_TEST_CASE(doubled_faces_are_counted_beside_polygons_that_are_divided) {
  Face_soup soup;
  for (int k = 0; k < 4; ++k)
    soup.add_point(k == 1, k == 2, k == 3);
  soup.add_face(std::array{0, 2, 1, 0, 1, 3}); // two faces that meet in the corner 0
  for (const auto& f : {std::array{1, 2, 3}, {2, 0, 3}, {3, 2, 0}})
    soup.add_face(f);
  const Repair_report report = repair(soup);
  BOOST_TEST(report.is_repaired());
  BOOST_TEST(count_of(report, Repair_kind::drop_faces, "polygons with a repeated corner divided there") == 1u);
  BOOST_TEST(count_of(report, Repair_kind::drop_faces, "doubled faces dropped") == 1u);
  BOOST_TEST(soup.number_of_faces() == 4u);
}

// Points whose distances have squares of 0 keep what is theirs.
BOOST_AUTO_TEST_CASE(attributes_of_points_that_do_not_move_stay_beside_points_that_are_far) {
  Triangle_list list = meshes::tetrahedron().scale_and_move(1, 5, 0, 0);
  list += meshes::tetrahedron().scale_and_move(0x1p-600, 0, 0, 0);
  Face_soup soup = soup_of(list);
  soup.attributes.push_back({"number", haptic_sculpt::Vertex_attribute::Type::float64, {}});
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    soup.attributes[0].values.push_back(static_cast<double>(v));
  soup.points.push_back(soup.points[0]); // without a face, so that there is something to repair
  soup.attributes[0].values.push_back(-1);
  const std::vector<Point_3> before = soup.points;
  BOOST_TEST(repair(soup).is_repaired());
  BOOST_REQUIRE(soup.points.size() == before.size() - 1);
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    BOOST_TEST((soup.points[v] == before[static_cast<std::size_t>(soup.attributes[0].values[v])]));
}

BOOST_AUTO_TEST_SUITE_END()
