// SPDX-License-Identifier: GPL-3.0-or-later
#include <haptic_sculpt/surface/validate.h>

#include "surface/soup_of.h"

#include <meshes/generated_meshes.h>
#include <oracle/exact_triangles.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Simple_cartesian.h>

#include <boost/test/unit_test.hpp>

#include <chrono>
#include <cmath>
#include <limits>
#include <random>

using haptic_sculpt::Face_soup;
using haptic_sculpt::validate;
using haptic_sculpt::validate_soup;
using haptic_sculpt::Validity_report;
using meshes::Mesh;
using meshes::to_mesh;
using haptic_sculpt::test::soup_of;
using meshes::Triangle_list;

namespace {

using V = Mesh::Vertex_index;
using F = Mesh::Face_index;

template <class Index>
std::vector<std::size_t> numbers(const std::vector<Index>& list) {
  return {list.begin(), list.end()};
}
template <class Index>
std::vector<std::pair<std::size_t, std::size_t>> pairs(const std::vector<std::pair<Index, Index>>& list) {
  return {list.begin(), list.end()};
}
using Numbers = std::vector<std::size_t>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

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

BOOST_AUTO_TEST_SUITE(validity)

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

BOOST_AUTO_TEST_CASE(an_empty_mesh_and_isolated_vertices) {
  BOOST_TEST(validate(Mesh()).is_valid());
  Mesh mesh = to_mesh(meshes::tetrahedron());
  mesh.add_vertex({0.25, 0.25, 0.25});
  mesh.add_vertex({0, 0, 0}); // on a vertex: a probe may
  const auto report = validate(mesh);
  BOOST_TEST(report.is_valid());
  BOOST_TEST(numbers(report.isolated_vertices) == (Numbers{4, 5}));
  mesh.point(V(4)) = {0, std::nan(""), 0};
  BOOST_TEST(numbers(validate(mesh).non_finite_vertices) == (Numbers{4}));
}

BOOST_AUTO_TEST_CASE(boundary_edges) {
  Mesh mesh = to_mesh(meshes::tetrahedron());
  CGAL::Euler::remove_face(mesh.halfedge(F(2)), mesh);
  const auto report = validate(mesh);
  BOOST_TEST(pairs(report.boundary_edges) == (Pairs{{1, 2}, {1, 3}, {2, 3}}));
  BOOST_TEST(report.number_of_faults() == 3u);
  BOOST_TEST(report.message().find("1-2, 1-3, 2-3") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(removed_elements_are_skipped_and_indices_kept) {
  auto list = meshes::tetrahedron();
  auto far = meshes::cube();
  list += far.scale_and_move(1, 5, 5, 5);
  Mesh mesh = to_mesh(list);
  for (int f = 0; f < 4; ++f)
    CGAL::Euler::remove_face(mesh.halfedge(F(f)), mesh);
  BOOST_TEST(mesh.has_garbage());
  BOOST_TEST(validate(mesh).is_valid());
  mesh.point(V(4)) = mesh.point(V(5));
  const auto report = validate(mesh);
  BOOST_TEST(pairs(report.coincident_vertices) == (Pairs{{4, 5}}));
  BOOST_TEST(!report.degenerate_faces.empty());
  for (const auto f : report.degenerate_faces)
    BOOST_TEST(std::size_t(f) >= 4u);
}

BOOST_AUTO_TEST_CASE(faces_that_are_not_triangles) {
  Mesh mesh = to_mesh(meshes::cube());
  const auto h = mesh.halfedge(F(0));
  auto diagonal = h;
  while (mesh.face(mesh.opposite(diagonal)) != F(1))
    diagonal = mesh.next(diagonal);
  CGAL::Euler::join_face(diagonal, mesh);
  const auto report = validate(mesh);
  BOOST_TEST(report.non_triangular_faces.size() == 1u);
  BOOST_TEST(report.number_of_faults() == 1u);
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

BOOST_AUTO_TEST_CASE(pinched_vertex_in_a_surface_mesh) {
  // Two tetrahedra through one vertex: Surface_mesh holds them without complaint.
  Mesh mesh = to_mesh(meshes::nearly_pinched(0));
  for (const auto h : CGAL::halfedges_around_target(mesh.halfedge(V(7)), mesh))
    mesh.set_target(h, V(3));
  mesh.remove_vertex(V(7));
  BOOST_TEST(mesh.is_valid(false));
  BOOST_TEST(CGAL::is_closed(mesh));
  const auto report = validate(mesh);
  BOOST_TEST(numbers(report.non_manifold_vertices) == (Numbers{3}));
  BOOST_TEST(report.number_of_faults() == 1u);
  // The same with two vertices at the point.
  const auto twice = validate(to_mesh(meshes::nearly_pinched(0)));
  BOOST_TEST(pairs(twice.coincident_vertices) == (Pairs{{3, 7}}));
  BOOST_TEST(twice.intersecting_faces.size() == 9u);
}

BOOST_AUTO_TEST_CASE(doubled_edge_in_a_surface_mesh) {
  // Four tetrahedron-like fans around one edge: two cubes that share an edge become one soup with an edge of four
  // faces.
  auto list = meshes::cube(), other = meshes::cube();
  other.scale_and_move(1, 1, 1, 0);
  auto soup = soup_of(list);
  std::map<meshes::Point_3, std::size_t> index;
  for (std::size_t i = 0; i < list.points.size(); ++i)
    index.emplace(list.points[i], i);
  for (const auto& p : other.points)
    if (index.emplace(p, soup.points.size()).second)
      soup.points.push_back(p);
  for (const auto& f : other.faces)
    soup.add_face(
        std::array<std::size_t, 3>{index[other.points[f[0]]], index[other.points[f[1]]], index[other.points[f[2]]]});
  const auto report = validate_soup(soup);
  BOOST_TEST(report.non_manifold_edges.size() == 1u);
  BOOST_TEST(report.non_manifold_vertices.empty()); // every fan at its ends hangs together through that edge
  BOOST_TEST(report.intersecting_faces.empty());

  // A Surface_mesh with two edges between the same vertices: flip an edge of the tetrahedron onto the opposite one.
  Mesh mesh = to_mesh(meshes::tetrahedron());
  CGAL::Euler::flip_edge(mesh.halfedge(V(0), V(1)), mesh);
  const auto flipped = validate(mesh);
  BOOST_TEST(pairs(flipped.non_manifold_edges) == (Pairs{{2, 3}}));
  BOOST_TEST(!flipped.is_valid());
}

BOOST_AUTO_TEST_CASE(faces_turned_over) {
  auto list = meshes::icosphere(1);
  std::swap(list.faces[10][0], list.faces[10][1]);
  const auto report = validate_soup(soup_of(list));
  BOOST_TEST(report.inconsistently_oriented_edges.size() == 3u);
  BOOST_TEST(report.number_of_faults() == 3u);
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

BOOST_AUTO_TEST_CASE(inconsistent_connectivity) {
  Mesh mesh = to_mesh(meshes::cube());
  const auto h = mesh.halfedge(F(3));
  mesh.set_next_only(h, h);
  BOOST_TEST(!validate(mesh).inconsistent_halfedges.empty());
  mesh = to_mesh(meshes::cube());
  mesh.set_target(h, V(1000));
  BOOST_TEST(!validate(mesh).inconsistent_halfedges.empty());
  mesh = to_mesh(meshes::cube());
  mesh.remove_vertex(V(2)); // while faces still use it
  BOOST_TEST(!validate(mesh).inconsistent_halfedges.empty());
  BOOST_TEST(validate(mesh).message().find("contradictory") != std::string::npos);
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

// Random triangles on a small grid: every way to share, touch, overlap and lie flat occurs.
BOOST_AUTO_TEST_CASE(intersections_agree_with_integers_on_degenerate_soups) {
  constexpr unsigned seed = 31;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  std::size_t wrong = 0, hits = 0, asked = 0;
  for (int round = 0; round < 6000; ++round) {
    const int grid = 2 + round % 3, n = 5 + round % 5;
    Face_soup soup;
    oracle::Mesh_list list;
    for (int i = 0; i < n; ++i) {
      const std::array<double, 3> p{double(random() % grid), double(random() % grid),
                                    round % 4 ? double(random() % grid) : 0.0};
      list.points.push_back(p);
      soup.points.emplace_back(p[0], p[1], p[2]);
    }
    for (int i = 0; i < 6; ++i) {
      const int a = random() % n, b = random() % n, c = random() % n;
      if (a == b || b == c || c == a)
        continue;
      list.faces.push_back({a, b, c});
      soup.add_face(std::array<int, 3>{a, b, c});
    }
    const auto report = validate_soup(soup);
    const std::vector<std::size_t> flat = numbers(report.degenerate_faces);
    const auto is_flat = [&](std::size_t f) { return std::binary_search(flat.begin(), flat.end(), f); };
    Pairs found, expected;
    for (const auto& [f, g] : report.intersecting_faces)
      if (!is_flat(f) && !is_flat(g))
        found.emplace_back(f, g);
    for (const auto& [f, g] : oracle::improper_pairs(list))
      expected.emplace_back(f, g);
    const auto points = oracle::scaled_to_integers(list.points);
    const oracle::Still_signs<mpz_class> signs{points};
    for (std::size_t f = 0; f < list.faces.size(); ++f) {
      const auto& t = list.faces[f];
      wrong += is_flat(f) != oracle::on_one_line(signs, t[0], t[1], t[2]);
    }
    wrong += found != expected;
    hits += expected.size();
    asked += list.faces.size() * (list.faces.size() - 1) / 2;
  }
  BOOST_TEST_MESSAGE(asked << " pairs, " << hits << " improper");
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(hits > asked / 20);
}

BOOST_AUTO_TEST_CASE(degenerate_faces_meet_others) {
  Face_soup soup = soup_of(meshes::cube());
  const auto flat = [&](const std::array<double, 3>& a, const std::array<double, 3>& b,
                        const std::array<double, 3>& c) {
    const std::size_t n = soup.points.size();
    for (const auto& p : {a, b, c})
      soup.points.emplace_back(p[0], p[1], p[2]);
    soup.add_face(std::array<std::size_t, 3>{n, n + 1, n + 2});
  };
  flat({.5, .3, .5}, {.5, .3, 3}, {.5, .3, 2});  // 12: out through a side
  flat({.5, .3, 1.5}, {.5, .3, 3}, {.5, .3, 2}); // 13: outside, overlaps 12
  flat({.5, -.3, 2}, {.5, 3, 2}, {.5, 1, 2});    // 14: crosses 12 and 13
  flat({7, 7, 7}, {7, 7, 7}, {7, 7, 7});         // 15: a point
  const auto report = validate_soup(soup);
  BOOST_TEST(numbers(report.degenerate_faces) == (Numbers{12, 13, 14, 15}));
  Pairs among, with_cube;
  for (const auto& [f, g] : report.intersecting_faces)
    (f >= F(12) ? among : with_cube).emplace_back(f, g);
  BOOST_TEST(among == (Pairs{{12, 13}, {12, 14}, {13, 14}}));
  BOOST_TEST(with_cube.size() == 1u);
}

BOOST_AUTO_TEST_CASE(agrees_with_polygon_mesh_processing) {
  constexpr unsigned seed = 5;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  std::size_t hits = 0;
  for (int round = 0; round < 30; ++round) {
    auto list = meshes::icosphere(3);
    list.transform([&](const meshes::Point_3& p) {
      const auto noise = [&] { return 0.02 * round * (random() / 4294967296.0 - 0.5); };
      return meshes::Point_3(p.x() + noise(), p.y() + noise(), p.z() + noise());
    });
    const Mesh mesh = to_mesh(list);
    std::vector<std::pair<F, F>> expected;
    CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(expected));
    for (auto& [f, g] : expected)
      if (g < f)
        std::swap(f, g);
    std::sort(expected.begin(), expected.end());
    const auto report = validate(mesh, 0, Validity_report::all_intersections);
    BOOST_TEST((report.intersecting_faces == expected));
    hits += expected.size();
  }
  BOOST_TEST_MESSAGE(hits << " intersecting pairs");
  BOOST_TEST(hits > 1000u);
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
