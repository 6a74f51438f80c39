// SPDX-License-Identifier: GPL-3.0-or-later
#include <haptic_sculpt/surface/validate.h>

#include "surface/index_lists.h"
#include "surface/soup_of.h"

#include <meshes/generated_meshes.h>

#include <CGAL/Simple_cartesian.h>

#include <boost/test/unit_test.hpp>

#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

using haptic_sculpt::Face_soup;
using haptic_sculpt::validate;
using haptic_sculpt::validate_soup;
using haptic_sculpt::Validity_report;
using haptic_sculpt::test::soup_of;
using meshes::Mesh;
using meshes::to_mesh;
using meshes::Triangle_list;

BOOST_AUTO_TEST_SUITE(validity)

namespace {

void check_clean(const Triangle_list& list, std::size_t components, double delta = 0) {
  BOOST_TEST_CONTEXT(list.points.size() << " points, " << list.points.back()) {
    const Validity_report report = validate(to_mesh(list), delta);
    BOOST_TEST(report.is_valid(), report.message());
    BOOST_TEST(report.message().empty());
    BOOST_TEST(report.number_of_components == components);
    BOOST_TEST(report.inside_out_components.empty());
    BOOST_TEST(report.isolated_vertices.empty());
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(generated_meshes_are_valid) {
  check_clean(meshes::tetrahedron(), 1);
  check_clean(meshes::cube(), 1);
  check_clean(meshes::box(6), 1);
  for (int n = 0; n < 5; ++n)
    check_clean(meshes::icosphere(n), 1);
  check_clean(meshes::bumpy_sphere(5, 0.4, 0.002, 7), 1);
  check_clean(meshes::torus(3, 3), 1);
  check_clean(meshes::torus(40, 17), 1);
  check_clean(meshes::bipyramid(3), 1);
  check_clean(meshes::bipyramid(1000), 1);
  check_clean(meshes::row_of_spheres(7), 7);
  check_clean(meshes::ball_in_a_cavity(), 3);
  for (const double gap : {0.1, 1e-12, 1e-300, std::numeric_limits<double>::denorm_min()}) {
    check_clean(meshes::c_tube(gap), 1);
    check_clean(meshes::nearly_pinched(gap), 2);
  }
  check_clean(meshes::sliver_stack(200, std::ldexp(1, -39)), 1);
  check_clean(meshes::sliver_stack(3, std::ldexp(1, -1070)), 1);
  auto moved = meshes::bumpy_sphere(3);
  check_clean(moved.scale_and_move(1, 1e6, -1e6, 1e6), 1);
  auto huge = meshes::icosphere(2), tiny = meshes::icosphere(1);
  check_clean(huge.scale_and_move(1e307, 0, 0, 0), 1);
  check_clean(tiny.scale_and_move(1e-319, 0, 0, 0), 1);
}

BOOST_AUTO_TEST_CASE(a_list_of_faces_that_was_moved_from_can_be_filled_again) {
  Face_soup soup;
  soup.add_face(std::array<int, 3>{0, 1, 2});
  const Face_soup taken = std::move(soup);
  BOOST_TEST(taken.number_of_faces() == 1u);
  soup.points.clear(), soup.corners.clear();
  for (const auto& p : {std::array<double, 3>{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
    soup.add_point(p[0], p[1], p[2]);
  for (const auto& face : {std::array<int, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
    soup.add_face(face);
  BOOST_TEST(soup.number_of_faces() == 4u);
  BOOST_TEST(validate_soup(soup).is_valid());
}

// Corners that end before their face has been closed are of no face.
BOOST_AUTO_TEST_CASE(a_face_that_cannot_be_added_is_not_part_of_the_next) {
  struct Ends {};
  struct Corners {
    struct Iterator {
      int at;
      int operator*() const { return at < 2 ? at : throw Ends(); }
      Iterator& operator++() { return ++at, *this; }
      bool operator!=(const Iterator& other) const { return at != other.at; }
    };
    Iterator begin() const { return {0}; }
    Iterator end() const { return {3}; }
  };
  Face_soup soup;
  BOOST_CHECK_THROW(soup.add_face(Corners()), Ends);
  soup.add_face(std::array<int, 3>{0, 1, 2});
  BOOST_TEST(soup.number_of_faces() == 1u);
  BOOST_TEST(soup.number_of_corners(0) == 3u);
}

BOOST_AUTO_TEST_CASE(an_empty_mesh_and_isolated_vertices) {
  BOOST_TEST(validate(Mesh()).is_valid());
  Mesh mesh = to_mesh(meshes::tetrahedron());
  mesh.add_vertex({0.25, 0.25, 0.25});
  mesh.add_vertex({0, 0, 0}); // on a vertex: not told twice
  const auto report = validate(mesh);
  BOOST_TEST(report.number_of_faults() == 2u);
  BOOST_TEST(numbers(report.isolated_vertices) == (Numbers{4, 5}));
  BOOST_TEST(report.is_repairable());
  BOOST_TEST(report.message().find("2 vertex(es) without faces: 4, 5. ") == 0u);
  mesh.point(V(4)) = {0, std::nan(""), 0};
  BOOST_TEST(numbers(validate(mesh).non_finite_vertices) == (Numbers{4}));
}

BOOST_AUTO_TEST_CASE(degenerate_and_low_faces) {
  Mesh mesh = to_mesh(meshes::bipyramid(4));
  mesh.point(V(0)) = {1, 0, 0};
  mesh.point(V(1)) = {0, 1, 0};
  mesh.point(V(4)) = {0.5, 0.5, 0}; // the upper apex, on the edge 0-1
  const auto report = validate(mesh);
  BOOST_TEST(numbers(report.degenerate_faces) == (Numbers{0}));
  BOOST_TEST(!report.is_valid());
  // A unit right angle: altitudes 1, 1, sqrt(1/2); the slanted face of the tetrahedron: sqrt(3/2).
  const Mesh corner = to_mesh(meshes::tetrahedron());
  BOOST_TEST(validate(corner, 0.7071).is_valid());
  BOOST_TEST(numbers(validate(corner, 0.7072).low_faces) == (Numbers{0, 1, 3}));
  BOOST_TEST(validate(corner, 1.3).low_faces.size() == 4u);
  BOOST_CHECK_THROW(validate(corner, -1), haptic_sculpt::Error);
  BOOST_CHECK_THROW(validate(corner, std::numeric_limits<double>::infinity()), haptic_sculpt::Error);
}

BOOST_AUTO_TEST_CASE(coordinates_that_are_not_finite) {
  Mesh mesh = to_mesh(meshes::icosphere(1));
  mesh.point(V(3)) = {0, 0, std::numeric_limits<double>::infinity()};
  mesh.point(V(9)) = {std::nan(""), 0, 0};
  const auto report = validate(mesh);
  BOOST_TEST(numbers(report.non_finite_vertices) == (Numbers{3, 9}));
  BOOST_TEST(report.number_of_faults() == 2u);
}

BOOST_AUTO_TEST_CASE(inside_out_components_are_told_but_valid) {
  auto list = meshes::row_of_spheres(2);
  auto third = meshes::icosphere(1);
  list += third.scale_and_move(0.4, 2, 0, 0).turn_inside_out();
  auto report = validate(to_mesh(list));
  BOOST_TEST(report.is_valid());
  BOOST_TEST(numbers(report.inside_out_components) == (Numbers{160}));
  // A cavity whose wall points outwards, seen in a nest that is everywhere in special position to an axis ray.
  auto nest = meshes::box(4, 8), wall = meshes::box(4, 4), core = meshes::box(4, 2);
  nest += wall.scale_and_move(1, 2, 2, 2);
  nest += core.scale_and_move(1, 3, 3, 3);
  report = validate(to_mesh(nest));
  BOOST_TEST(report.is_valid(), report.message());
  BOOST_TEST(numbers(report.inside_out_components) == (Numbers{192}));
  auto tiny = meshes::ball_in_a_cavity();
  BOOST_TEST(validate(to_mesh(tiny.turn_inside_out())).inside_out_components.size() == 3u);
  BOOST_TEST(validate(to_mesh(tiny.turn_inside_out().scale_and_move(1e-318, 0, 0, 0))).inside_out_components.empty());
  auto wide = meshes::ball_in_a_cavity();
  BOOST_TEST(validate(to_mesh(wide.scale_and_move(8e307, 0, 0, 0))).inside_out_components.empty());
}

BOOST_AUTO_TEST_CASE(all_kinds_at_once) {
  Face_soup soup = soup_of(meshes::cube()); // 0..7, faces 0..11
  const auto add = [&](std::initializer_list<std::array<double, 3>> points) {
    std::vector<std::size_t> face;
    for (const auto& p : points) {
      face.push_back(soup.points.size());
      soup.points.emplace_back(p[0], p[1], p[2]);
    }
    soup.add_face(face);
  };
  add({{0.5, 0.5, -1}, {0.5, 0.6, 2}, {0.6, 0.5, 2}}); // 12, through two sides, boundary
  add({{5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}});   // 13, a quadrangle
  add({{5, 5, 5}, {6, 6, 6}, {7, 7, 7}});              // 14, degenerate
  add({{9, 0, 0}, {9, 0, 0}, {9, 1, std::nan("")}});   // 15, not finite, coincident
  add({{20, 0, 0}, {30, 0, 0}, {25, 1e-3, 0}});        // 16, low
  soup.add_face(std::array<std::size_t, 3>{soup.corners[0], soup.corners[1], soup.corners[11]}); // 17, a third face
  const auto report = validate_soup(soup, 0.01);
  BOOST_TEST(report.non_triangular_faces.size() == 1u);
  BOOST_TEST(numbers(report.degenerate_faces) == (Numbers{14}));
  BOOST_TEST(numbers(report.low_faces) == (Numbers{16}));
  BOOST_TEST(report.non_finite_vertices.size() == 1u);
  BOOST_TEST(report.coincident_vertices.size() == 1u);
  BOOST_TEST(report.boundary_edges.size() >= 15u);
  BOOST_TEST(!report.non_manifold_edges.empty());
  BOOST_TEST(!report.intersecting_faces.empty());
  const std::string text = report.message(2);
  for (const char* word : {"not triangles: 13", "degenerate", "below delta = 0.01", "infinite", "at one point",
                           "boundary", "more than two faces", "intersecting", ", ...", "PMP::"})
    BOOST_TEST(text.find(word) != std::string::npos, word);
}

BOOST_AUTO_TEST_CASE(property_maps_of_either_cgal) {
  Mesh mesh = to_mesh(meshes::tetrahedron());
  auto map = mesh.add_property_map<V, int>("v:colour", 3).first;
  map[V(2)] = 5;
  const auto found = haptic_sculpt::find_property_map<V, int>(mesh, "v:colour");
  BOOST_REQUIRE(found.has_value());
  BOOST_TEST((*found)[V(2)] == 5);
  BOOST_TEST((!haptic_sculpt::find_property_map<V, double>(mesh, "v:colour")));
  BOOST_TEST((!haptic_sculpt::find_property_map<V, int>(mesh, "v:other")));
}

BOOST_AUTO_TEST_CASE(any_kernel_on_doubles) {
  using Simple = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
  BOOST_TEST(validate(to_mesh<Simple>(meshes::c_tube(1e-12))).is_valid());
  BOOST_TEST(!validate(to_mesh<Simple>(meshes::c_tube(0))).is_valid());
}

BOOST_AUTO_TEST_CASE(a_large_mesh_in_reasonable_time) {
  const auto start = std::chrono::steady_clock::now();
  const Mesh mesh = to_mesh(meshes::torus(1000, 200));
  const auto built = std::chrono::steady_clock::now();
  const auto report = validate(mesh);
  const auto end = std::chrono::steady_clock::now();
  BOOST_TEST(report.is_valid());
  BOOST_TEST_MESSAGE("400,000 triangles: built in " << std::chrono::duration<double>(built - start).count()
                                                    << " s, validated in "
                                                    << std::chrono::duration<double>(end - built).count() << " s");
}

BOOST_AUTO_TEST_SUITE_END()
