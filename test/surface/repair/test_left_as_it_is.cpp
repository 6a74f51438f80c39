// SPDX-License-Identifier: GPL-3.0-or-later
// What is valid, and what cannot be repaired, is left as it is, bit for bit.
#include <haptic_sculpt/surface/repair.h>

#include "surface/identical.h"
#include "surface/soup_of.h"

#include <meshes/broken_meshes.h>

#include <boost/test/unit_test.hpp>

#include <limits>
#include <random>

namespace {

using haptic_sculpt::Face_soup;
using haptic_sculpt::repair;
using haptic_sculpt::Repair_parameters;
using haptic_sculpt::Repair_report;
using haptic_sculpt::test::soup_of;
using meshes::Mesh;
using meshes::Point_3;
using meshes::Triangle_list;
using reading_and_writing::identical;

} // namespace

BOOST_AUTO_TEST_SUITE(repairing)

// Of a ball whose vertices are anywhere no other shape is made.
BOOST_AUTO_TEST_CASE(what_crosses_itself_all_over_is_refused) {
  constexpr std::uint32_t seed = 5;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  const auto anywhere = [&] { return random() / 4294967296.0; };
  Triangle_list list = meshes::icosphere(2);
  for (auto& p : list.points) {
    const double x = anywhere(), y = anywhere(), z = anywhere();
    p = Point_3(x, y, z);
  }
  Face_soup soup = soup_of(list);
  const Repair_report report = repair(soup);
  BOOST_TEST(!report.is_repaired());
  BOOST_TEST(!report.left.intersecting_faces.empty());
  BOOST_TEST(identical(soup, soup_of(list)));
}

BOOST_AUTO_TEST_CASE(what_is_valid_is_left_as_it_is) {
  Triangle_list list = meshes::ball_in_a_cavity();
  Face_soup soup = soup_of(list);
  const Repair_report report = repair(soup);
  BOOST_TEST(report.is_repaired());
  BOOST_TEST(report.steps.empty());
  BOOST_TEST(identical(soup, soup_of(list)));
  BOOST_TEST(report.points_before == list.points.size());
  Mesh mesh = meshes::to_mesh(list);
  const auto ids = mesh.add_property_map<Mesh::Vertex_index, int>("v:id", 7).first;
  const Mesh before = mesh;
  BOOST_TEST(repair(mesh).is_repaired());
  BOOST_TEST(identical(mesh, before));
  BOOST_TEST(ids[Mesh::Vertex_index(0)] == 7);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_repaired_is_left_as_it_is) {
  Triangle_list list = meshes::ball_with_a_hole();
  Face_soup soup = soup_of(list);
  Repair_report report = repair(soup, Repair_parameters().largest_hole(23));
  BOOST_TEST(!report.is_repaired());
  BOOST_TEST(report.left.boundary_edges.size() == 24u);
  BOOST_TEST(identical(soup, soup_of(list)));
  BOOST_TEST(report.attempt.number_of_faces() == list.faces.size());
  for (const auto& edge : report.left.boundary_edges)
    BOOST_TEST(std::size_t(edge.second) < report.attempt.points.size());
  BOOST_TEST(repair(soup, Repair_parameters().largest_hole(24)).is_repaired());

  soup = soup_of(list);
  soup.points[3] = Point_3(0, std::numeric_limits<double>::quiet_NaN(), 0);
  report = repair(soup);
  BOOST_TEST(!report.is_repaired());
  BOOST_REQUIRE(report.left.non_finite_vertices.size() == 1u);
  BOOST_TEST(std::size_t(report.left.non_finite_vertices[0]) == 3u);

  soup = soup_of(list);
  soup.points[4] = Point_3(0, 0x1p1001, 0);
  BOOST_CHECK_THROW(repair(soup), haptic_sculpt::Out_of_range);
  soup = soup_of(list);
  soup.corners[7] = 100000;
  BOOST_CHECK_THROW(repair(soup), haptic_sculpt::Error);
  soup = soup_of(list);
  BOOST_CHECK_THROW(repair(soup, Repair_parameters().gap(-1)), haptic_sculpt::Out_of_range);
  BOOST_CHECK_THROW(repair(soup, Repair_parameters().gap(std::numeric_limits<double>::quiet_NaN())),
                    haptic_sculpt::Out_of_range);
  BOOST_CHECK_THROW(repair(soup, Repair_parameters().delta(-1)), haptic_sculpt::Error); // before any work
  // A sheet, with its other side upon it, holds nothing.
  Triangle_list sheet;
  sheet.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.add_quadrangle(0, 1, 2, 3);
  soup = soup_of(sheet);
  report = repair(soup);
  BOOST_TEST(!report.is_repaired());
  BOOST_TEST(identical(soup, soup_of(sheet)));
  soup = Face_soup();
  BOOST_TEST(repair(soup).is_repaired());
}

BOOST_AUTO_TEST_CASE(of_what_has_no_area_nothing_is_made) {
  for (const bool is_point : {true, false})
    BOOST_TEST_CONTEXT((is_point ? "all corners at one point" : "all corners on a line")) {
      Triangle_list list = meshes::icosphere(2);
      for (std::size_t v = 0; v < list.points.size(); ++v)
        list.points[v] = Point_3(is_point ? 1 : static_cast<double>(v), 2, 3);
      Face_soup soup = soup_of(list);
      const Repair_report report = repair(soup);
      BOOST_TEST(!report.is_repaired());
      BOOST_TEST(report.has_vanished);
      BOOST_TEST(report.message().find("no face is left") != std::string::npos, report.message());
      BOOST_TEST(identical(soup, soup_of(list)));
      Mesh mesh = meshes::to_mesh(list);
      BOOST_TEST(!repair(mesh).is_repaired());
      BOOST_TEST(mesh.number_of_faces() == list.faces.size());
    }
}

BOOST_AUTO_TEST_SUITE_END()
