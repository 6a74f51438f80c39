// SPDX-License-Identifier: GPL-3.0-or-later
// The steps of a repair that look at corners alone: what they count, and what keeps its attributes.
#include "surface/repair/count_of.h"
#include "surface/soup_of.h"

#include <meshes/broken_meshes.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

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

// As the pixels of a depth image that saw nothing: a search tree of equal points would be as deep as they are many.
BOOST_AUTO_TEST_CASE(attributes_beside_many_points_at_one_place) {
  Face_soup soup = soup_of(meshes::tetrahedron());
  soup.points.insert(soup.points.begin(), 100000, Point_3(9, 9, 9));
  for (auto& corner : soup.corners)
    corner += 100000;
  soup.points.emplace_back(0x1p1000, 0, 0);
  soup.attributes.push_back({"number", haptic_sculpt::Vertex_attribute::Type::float64, {}});
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    soup.attributes[0].values.push_back(static_cast<double>(v));
  for (const bool have_moved : {false, true}) {
    Face_soup to = soup_of(meshes::tetrahedron().scale_and_move(have_moved ? 1.001 : 1, 0, 0, 0));
    haptic_sculpt::internal::copy_attributes(soup, to);
    BOOST_TEST((to.attributes[0].values == std::vector<double>{100000, 100001, 100002, 100003}));
  }
  BOOST_TEST(repair(soup).is_repaired());
  BOOST_REQUIRE(soup.points.size() == 4u);
  const std::vector<Point_3> before = soup_of(meshes::tetrahedron()).points;
  for (std::size_t v = 0; v < 4; ++v)
    BOOST_TEST((soup.points[v] == before[static_cast<std::size_t>(soup.attributes[0].values[v]) - 100000]));
}

// The unit to compute in is that of the faces.
BOOST_AUTO_TEST_CASE(a_point_without_a_face_that_is_far_off_does_not_matter) {
  const auto triangles_of = [](const Face_soup& soup) {
    std::set<std::array<Point_3, 3>> all;
    for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
      std::array<Point_3, 3> corners{soup.points[soup.begin(f)[0]], soup.points[soup.begin(f)[1]],
                                     soup.points[soup.begin(f)[2]]};
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      all.insert(corners);
    }
    return all;
  };
  for (const double size : {1.0, 0x1p-600, 0x1p600}) {
    Face_soup alone = soup_of(meshes::ball_with_a_hole().scale_and_move(size, 0, 0, 0)), beside = alone;
    for (const double far : {0x1p500, 0x1p1000, 0x1p-600, 0x1p-1074})
      beside.points.emplace_back(far, far, far);
    BOOST_TEST(repair(alone).is_repaired());
    const Repair_report report = repair(beside);
    BOOST_TEST(report.is_repaired());
    BOOST_TEST(count_of(report, Repair_kind::drop_points, "points without faces dropped") >= 4u);
    BOOST_TEST((triangles_of(alone) == triangles_of(beside)));
  }
}

BOOST_AUTO_TEST_CASE(what_a_step_leaves_without_a_face_comes_back_from_the_unit) {
  Face_soup soup = soup_of(meshes::tetrahedron().scale_and_move(0x1p600, 0, 0, 0));
  const Face_soup before = soup;
  soup.points.emplace_back(1, 1, 1);
  const haptic_sculpt::internal::Unit_scale unit(soup, std::nullopt);
  unit.down(soup);
  BOOST_TEST(unit.down(0x1p600) <= 1);
  BOOST_TEST((soup.points.back() == Point_3(1, 1, 1))); // without a face as it was given, so it stays
  soup.points.back() = soup.points[1];
  soup.corners.clear();
  soup.first_corner.assign(1, 0);
  unit.up(soup);
  BOOST_TEST((soup.points.back() == before.points[1] && before.points[1].x() == 0x1p600));
}

// Faces with a hole enclose no volume, whichever corner they begin with.
BOOST_AUTO_TEST_CASE(an_open_part_is_no_sheet) {
  for (int first = 0; first < 3; ++first) {
    Face_soup soup = soup_of(meshes::icosphere(1));
    const auto apex = soup.points.size();
    soup.points.emplace_back(10, 0, 1);
    for (int k = 0; k < 5; ++k) // a fan that winds about its apex twice, and so crosses itself
      soup.points.emplace_back(10 + std::cos(k * 2.513274), std::sin(k * 2.513274), 0);
    for (std::size_t k = 0; k < 5; ++k) {
      std::array<std::size_t, 3> face{apex + 1 + k, apex + 1 + (k + 1) % 5, apex};
      std::rotate(face.begin(), face.begin() + first, face.end());
      soup.add_face(face);
    }
    const Repair_report report = repair(soup, haptic_sculpt::Repair_parameters().largest_hole(4));
    BOOST_TEST(!report.is_repaired());
    BOOST_TEST(report.left.boundary_edges.size() == 5u);
  }
}

BOOST_AUTO_TEST_SUITE_END()
