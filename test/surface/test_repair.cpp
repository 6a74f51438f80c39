// SPDX-License-Identifier: GPL-3.0-or-later
#include <haptic_sculpt/surface/repair.h>

#include <haptic_sculpt/surface/read_surface.h>

#include "surface/identical.h"
#include "surface/open_edge.h"
#include "surface/repair/count_of.h"
#include "surface/soup_of.h"

#include <meshes/broken_meshes.h>

#include <shared_data.h>

#include <CGAL/Polygon_mesh_processing/orientation.h>

#include <boost/test/unit_test.hpp>

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <set>

namespace {

using haptic_sculpt::Face_soup;
using haptic_sculpt::repair;
using haptic_sculpt::Repair_kind;
using haptic_sculpt::Repair_parameters;
using haptic_sculpt::Repair_report;
using haptic_sculpt::validate;
using haptic_sculpt::validate_soup;
using haptic_sculpt::test::count_of;
using haptic_sculpt::test::soup_of;
using meshes::Mesh;
using meshes::Point_3;
using meshes::Triangle_list;
using reading_and_writing::identical;

mpq_class squared_distance(const Point_3& p, const Point_3& q) {
  mpq_class sum = 0;
  for (int k = 0; k < 3; ++k) {
    const mpq_class d = mpq_class(p[k]) - mpq_class(q[k]);
    sum += d * d;
  }
  return sum;
}

/// The counts that hold for every report, and distances against what can be said without it: no point that has moved
/// can have gone less far than to the nearest vertex there is.
void check_distances(const Face_soup& before, const Face_soup& after, const Repair_report& report) {
  std::vector<bool> used(before.points.size(), false);
  for (const auto corner : before.corners)
    used[corner] = true;
  std::size_t kept = 0;
  std::vector<Point_3> seen;
  for (std::size_t v = 0; v < before.points.size(); ++v)
    if (used[v] && std::find(seen.begin(), seen.end(), before.points[v]) == seen.end()) {
      seen.push_back(before.points[v]);
      kept += std::find(after.points.begin(), after.points.end(), before.points[v]) != after.points.end();
    }
  BOOST_TEST(report.points_before == seen.size());
  if (report.moved == 0)
    BOOST_TEST(kept == seen.size() - report.points_removed);
  for (const Point_3& p : seen) {
    mpq_class nearest = squared_distance(p, after.points[0]);
    for (const Point_3& q : after.points)
      nearest = std::min(nearest, squared_distance(p, q));
    if (report.points_removed == 0)
      BOOST_TEST((nearest <= mpq_class(report.moved) * mpq_class(report.moved) * mpq_class(1 + 1e-14)));
  }
}

} // namespace

BOOST_AUTO_TEST_SUITE(repairing)

BOOST_AUTO_TEST_CASE(broken_meshes_come_through) {
  for (const auto& [name, list] : meshes::broken_meshes()) {
    BOOST_TEST_CONTEXT(name) {
      const Face_soup broken = soup_of(list);
      Face_soup soup = broken;
      const Repair_report report = repair(soup);
      BOOST_TEST_MESSAGE(name << '\n' << report.message());
      BOOST_TEST(report.is_repaired());
      BOOST_TEST(!report.steps.empty());
      const auto valid = validate_soup(soup);
      BOOST_TEST(valid.is_valid(), valid.message());
      BOOST_TEST(valid.inside_out_components.empty());
      BOOST_TEST(valid.isolated_vertices.empty());
      if (report.is_repaired())
        check_distances(broken, soup, report);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_elk) {
  const auto path = haptic_sculpt::test::shared_data("meshes/cgal_elk.off");
  if (!path)
    return;
  Face_soup soup = haptic_sculpt::read_face_soup(*path);
  const Face_soup broken = soup;
  const Repair_report report = repair(soup);
  BOOST_TEST_MESSAGE(report.message());
  BOOST_TEST(report.is_repaired());
  BOOST_TEST(validate_soup(soup).is_valid());
  check_distances(broken, soup, report);
}

BOOST_AUTO_TEST_CASE(an_attribute_that_lacks_values_is_refused) {
  Face_soup soup = soup_of(meshes::tetrahedron());
  soup.attributes.push_back({"weight", haptic_sculpt::Vertex_attribute::Type::float64, {1, 2, 3}});
  BOOST_CHECK_THROW(repair(soup), haptic_sculpt::Error);
  BOOST_CHECK_THROW(haptic_sculpt::make_surface<meshes::Mesh>(soup), haptic_sculpt::Error);
  soup.attributes[0].values.push_back(4);
  BOOST_TEST(haptic_sculpt::make_surface<meshes::Mesh>(soup).number_of_vertices() == 4u);
}

// Vertices of a ball pulled through its other side, and farther: they go, with few others, and nothing moves.
BOOST_AUTO_TEST_CASE(what_crosses_itself_is_cut_out) {
  Triangle_list list = meshes::icosphere(3);
  for (const std::size_t v : {0, 100, 300})
    list.points[v] = Point_3(-1.25 * list.points[v].x(), -1.25 * list.points[v].y(), -1.25 * list.points[v].z());
  const Face_soup broken = soup_of(list);
  BOOST_TEST(!validate_soup(broken).intersecting_faces.empty());
  Face_soup soup = broken;
  const Repair_report report = repair(soup);
  BOOST_TEST(report.is_repaired(), report.message());
  BOOST_TEST(validate_soup(soup).is_valid());
  BOOST_TEST(validate_soup(soup).number_of_components == 1u);
  BOOST_TEST(report.moved == 0);
  BOOST_TEST(report.points_added == 0u);
  BOOST_TEST(report.points_removed <= 20u);
  check_distances(broken, soup, report);
}

// Five corners as far apart as doubles go, which no power of two brings near 1 without loss: its normal overflows.
BOOST_AUTO_TEST_CASE(a_polygon_of_any_size_is_divided) {
  Face_soup soup;
  for (const auto& p :
       {std::array{0x1p999, 0.0}, {0.0, 0x1p999}, {-0x1p999, 0.0}, {0.0, -0x1p999}, {0x1p500, -0x1p998}})
    soup.add_point(p[0], p[1], 0x1p-1000);
  soup.add_point(0, 0, 1);
  soup.add_face(std::array{0, 1, 2, 3, 4});
  for (int k = 0; k < 5; ++k)
    soup.add_face(std::array{(k + 1) % 5, k, 5});
  const Repair_report report = repair(soup);
  BOOST_TEST(report.is_repaired());
  BOOST_TEST(count_of(report, Repair_kind::divide_faces, "faces divided into triangles") == 1u);
  BOOST_TEST(soup.points.size() == 6u);
  BOOST_TEST(soup.number_of_faces() == 8u);
  BOOST_TEST(validate_soup(soup).is_valid());
}

// Distances that are known beforehand, in integers and powers of two.
BOOST_AUTO_TEST_CASE(moved_distances_are_those_of_the_input) {
  Triangle_list list = meshes::box(1, 4);
  const std::size_t corner = list.faces[0][1];
  const Point_3 p = list.points[corner];
  list.faces[0][1] = list.add_point(p.x() + 0x1p-22, p.y(), p.z()); // opens two edges
  Face_soup soup = soup_of(list);
  const Repair_report report = repair(soup);
  BOOST_TEST(report.is_repaired());
  BOOST_TEST(count_of(report, Repair_kind::close_gaps, "points on open edges merged with near ones") == 1u);
  BOOST_TEST(report.moved == 0x1p-22);
  BOOST_TEST(report.points_before == 9u);
  BOOST_TEST(report.points_removed == 0u);
  BOOST_TEST(report.points_added == 0u);
  // 2^-20 of the diagonal is 6.6e-6; that far apart they are two, and the hole between them is closed with slivers.
  soup = soup_of(list);
  const Repair_report without = repair(soup, Repair_parameters().gap(0));
  BOOST_TEST(count_of(without, Repair_kind::close_gaps, "points on open edges merged with near ones") == 0u);
  BOOST_TEST(without.moved == 0);
}

BOOST_AUTO_TEST_CASE(a_gap_spares_edges_unless_it_was_asked_for) {
  Triangle_list list = meshes::soup_with_gaps(meshes::icosphere(2), 0.01);
  Face_soup soup = soup_of(list);
  BOOST_TEST(!repair(soup).is_repaired());
  BOOST_TEST(identical(soup, soup_of(list)));
  const Repair_report report = repair(soup, Repair_parameters().gap(0.01));
  BOOST_TEST(report.is_repaired());
  BOOST_TEST(report.moved > 0);
  BOOST_TEST(report.moved <= 0.01);
  BOOST_TEST(soup.points.size() == 162u);
  // A mesh whose edges are shorter than the gap: nothing but equal points become one.
  const double tiny = 0x1p-24;
  list = meshes::ball_with_a_hole();
  list.scale_and_move(tiny, 0, 0, 0);
  auto far = meshes::cube();
  list += far.scale_and_move(1, 1, 0, 0);
  soup = soup_of(list);
  const Repair_report spared = repair(soup);
  BOOST_TEST(spared.is_repaired());
  BOOST_TEST(spared.moved == 0);
}

// Four triangles at an edge have no volume: what a round makes of them the next one takes back, and is not reported.
BOOST_AUTO_TEST_CASE(rounds_in_circles_are_not_reported) {
  Triangle_list fan;
  fan.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  for (std::size_t k = 2; k < 6; ++k)
    fan.add_face(0, 1, k);
  Face_soup soup = soup_of(fan);
  const Repair_report report = repair(soup);
  BOOST_TEST(!report.is_repaired());
  BOOST_TEST(std::count_if(report.steps.begin(), report.steps.end(),
                           [](const auto& step) { return step.kind == Repair_kind::close_holes; }) == 1);
  soup.points[3] = Point_3(0, std::numeric_limits<double>::infinity(), 0);
  BOOST_TEST(repair(soup).message().find("nothing to repair") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(meshes_are_repaired_in_place) {
  Mesh mesh = meshes::to_mesh(meshes::overlapping_balls());
  mesh.add_vertex(Point_3(50, 0, 0));
  const Repair_report report = repair(mesh);
  BOOST_TEST(report.is_repaired());
  BOOST_TEST(validate(mesh).is_valid());
  BOOST_TEST(validate(mesh).number_of_components == 1u);
  BOOST_TEST(count_of(report, Repair_kind::drop_points, "points without faces dropped") == 1u);
  // Removed elements are none: neither their points nor their numbers count.
  mesh = meshes::to_mesh(meshes::icosphere(2));
  mesh.remove_vertex(mesh.add_vertex(Point_3(std::numeric_limits<double>::infinity(), 0, 0)));
  BOOST_TEST(repair(mesh).steps.empty());
  // What is only inside out is turned, and stays the mesh that it is.
  mesh = meshes::to_mesh(meshes::cube());
  CGAL::Polygon_mesh_processing::reverse_face_orientations(mesh);
  mesh.add_property_map<Mesh::Vertex_index, int>("v:mine", 7);
  BOOST_TEST(count_of(repair(mesh), Repair_kind::orient_solids, "components turned") == 1u);
  BOOST_TEST(validate(mesh).inside_out_components.empty());
  BOOST_TEST((haptic_sculpt::find_property_map<Mesh::Vertex_index, int>(mesh, "v:mine").has_value()));
  // Not in place, for it cannot be repaired.
  Mesh open = meshes::to_mesh(meshes::ball_with_a_hole());
  const Mesh before = open;
  BOOST_TEST(!repair(open, Repair_parameters().largest_hole(0)).is_repaired());
  BOOST_TEST(identical(open, before));
  // A hole of which the faces know nothing.
  mesh = meshes::to_mesh(meshes::icosphere(1));
  haptic_sculpt::test::open_edge(mesh, *mesh.halfedges().begin());
  BOOST_TEST(!validate(mesh).is_valid());
  BOOST_TEST(count_of(repair(mesh), Repair_kind::stitch_edges, "pairs of open edges stitched") == 1u);
  BOOST_TEST(validate(mesh).is_valid());
  BOOST_TEST(mesh.number_of_faces() == 80u);
}

// The same to the bit at any unit, up to the bounds of the package.
BOOST_AUTO_TEST_CASE(units_do_not_matter) {
  for (const auto& [name, list] : meshes::broken_meshes())
    BOOST_TEST_CONTEXT(name) {
      Face_soup soup = soup_of(list);
      const Repair_report report = repair(soup);
      for (const int exponent : {-900, -300, 300, 990}) {
        Triangle_list scaled = list;
        scaled.scale_and_move(std::ldexp(1.0, exponent), 0, 0, 0);
        Face_soup other = soup_of(scaled);
        const Repair_report other_report = repair(other);
        BOOST_TEST(other_report.is_repaired());
        BOOST_TEST(std::ldexp(other_report.moved, -exponent) == report.moved);
        for (auto& p : other.points)
          p = Point_3(std::ldexp(p.x(), -exponent), std::ldexp(p.y(), -exponent), std::ldexp(p.z(), -exponent));
        BOOST_TEST(identical(other, soup));
      }
    }
}

// Two balls that overlap, one with a hole, all of it a soup with gaps, faces turned over, some twice.
BOOST_AUTO_TEST_CASE(faults_together) {
  constexpr std::uint32_t seed = 41;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  for (int i = 0; i < 6; ++i) {
    Triangle_list list = meshes::overlapping_balls(2);
    list.faces.resize(list.faces.size() - 3);
    for (auto& f : list.faces)
      if (random() % 4 == 0)
        std::swap(f[0], f[1]);
    for (int k = 0; k < 10; ++k)
      list.faces.push_back(list.faces[random() % list.faces.size()]);
    list = meshes::soup_with_gaps(list, 1e-7, random());
    list.add_face(0, 0, 1);
    Face_soup soup = soup_of(list);
    const Repair_report report = repair(soup);
    BOOST_TEST(report.is_repaired(), report.message());
    BOOST_TEST(validate_soup(soup).is_valid());
    BOOST_TEST(validate_soup(soup).number_of_components == 1u);
  }
}

BOOST_AUTO_TEST_CASE(polygons_are_divided) {
  Face_soup soup;
  for (int k = 0; k < 8; ++k)
    soup.add_point(k & 1, (k >> 1) & 1, k >> 2);
  for (const auto& f : {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    soup.add_face(f);
  const Repair_report report = repair(soup);
  BOOST_TEST(report.is_repaired());
  BOOST_TEST(count_of(report, Repair_kind::divide_faces, "faces divided into triangles") == 6u);
  BOOST_TEST(soup.number_of_faces() == 12u);
}

BOOST_AUTO_TEST_CASE(components_are_oriented_and_nothing_else) {
  Mesh mesh = meshes::to_mesh(meshes::flipped_component());
  const auto ids = mesh.add_property_map<Mesh::Vertex_index, int>("v:id", 7).first;
  const Face_soup before = haptic_sculpt::face_soup(mesh);
  BOOST_TEST(haptic_sculpt::orient_components(mesh) == 1u);
  const Face_soup after = haptic_sculpt::face_soup(mesh);
  BOOST_TEST(validate(mesh).inside_out_components.empty());
  BOOST_TEST(reading_and_writing::bits(after.points) == reading_and_writing::bits(before.points));
  for (std::size_t f = 0; f < before.number_of_faces(); ++f) {
    auto a = std::set<std::uint32_t>(before.begin(f), before.end(f)),
         b = std::set<std::uint32_t>(after.begin(f), after.end(f));
    BOOST_TEST(a == b);
    if (f < 320)
      BOOST_TEST(std::equal(before.begin(f), before.end(f), after.begin(f)));
  }
  BOOST_TEST(ids[Mesh::Vertex_index(0)] == 7);
  BOOST_TEST(haptic_sculpt::orient_components(mesh) == 0u);

  Face_soup soup = soup_of(meshes::ball_in_a_cavity());
  for (std::size_t f = 320; f < 640; ++f) // the wall of the cavity
    std::swap(soup.corners[3 * f], soup.corners[3 * f + 1]);
  BOOST_TEST(haptic_sculpt::orient_components(soup) == 1u);
  BOOST_TEST(validate_soup(soup).inside_out_components.empty());
  soup = soup_of(meshes::ball_with_a_hole());
  BOOST_CHECK_THROW(haptic_sculpt::orient_components(soup), haptic_sculpt::Invalid_surface);
}

BOOST_AUTO_TEST_SUITE_END()
