// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong with how faces hang together.
#include <haptic_sculpt/surface/orient_components.h>
#include <haptic_sculpt/surface/read_surface.h>

#include "surface/index_lists.h"
#include "surface/open_edge.h"
#include "surface/soup_of.h"

#include <meshes/generated_meshes.h>

#include <boost/test/unit_test.hpp>

#include <array>
#include <map>
#include <vector>

using haptic_sculpt::validate;
using haptic_sculpt::validate_soup;
using haptic_sculpt::test::soup_of;
using meshes::Mesh;
using meshes::to_mesh;

BOOST_AUTO_TEST_SUITE(validity)

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

BOOST_AUTO_TEST_CASE(inconsistent_connectivity) {
  Mesh mesh = to_mesh(meshes::cube());
  const auto h = mesh.halfedge(F(3));
  mesh.set_next_only(h, h);
  BOOST_TEST(!validate(mesh).inconsistent_halfedges.empty());
  BOOST_CHECK_THROW(validate(mesh, -1), haptic_sculpt::Error);
  mesh = to_mesh(meshes::cube());
  mesh.set_target(h, V(1000));
  BOOST_TEST(!validate(mesh).inconsistent_halfedges.empty());
  mesh = to_mesh(meshes::cube());
  mesh.remove_vertex(V(2)); // while faces still use it
  BOOST_TEST(!validate(mesh).inconsistent_halfedges.empty());
  BOOST_TEST(validate(mesh).message().find("contradictory") != std::string::npos);
  mesh = to_mesh(meshes::cube());
  mesh.set_halfedge(V(2), Mesh::null_halfedge()); // nothing would be found about it
  BOOST_TEST(!validate(mesh).inconsistent_halfedges.empty());
  mesh = to_mesh(meshes::cube());
  const auto bare = mesh.add_edge(V(0), V(7)); // no face has it
  mesh.set_next(bare, mesh.opposite(bare));
  mesh.set_next(mesh.opposite(bare), bare);
  BOOST_TEST(validate(mesh).inconsistent_halfedges.size() == 2u);
  mesh = to_mesh(meshes::cube());
  const auto number = mesh.number_of_faces();
  mesh.add_face(), mesh.add_face(); // without half-edges
  mesh.set_halfedge(F(3), mesh.halfedge(F(4)));
  mesh.set_halfedge(V(2), mesh.halfedge(V(5)));
  const auto report = validate(mesh);
  BOOST_TEST(report.inconsistent_halfedges.empty());
  BOOST_TEST((report.inconsistent_faces == std::vector{F(3), F(number), F(number + 1)}));
  BOOST_TEST((report.inconsistent_vertices == std::vector{V(2)}));
  BOOST_TEST(report.number_of_faults() == 4u);
  BOOST_TEST(!report.is_repairable());
  BOOST_TEST(report.message().find("name") != std::string::npos);
}

// A list of the faces of such a mesh is that of a closed one.
BOOST_AUTO_TEST_CASE(holes_of_two_edges) {
  Mesh mesh = to_mesh(meshes::cube());
  const auto h = mesh.halfedge(F(3));
  const Pairs ends = {std::minmax<std::uint32_t>({mesh.source(h), mesh.target(h)})};
  const auto own = haptic_sculpt::test::open_edge(mesh, h);
  BOOST_TEST(mesh.is_valid());
  BOOST_TEST(validate_soup(haptic_sculpt::face_soup(mesh)).is_valid());
  const auto report = validate(mesh);
  BOOST_TEST(pairs(report.boundary_edges) == ends);
  BOOST_TEST(report.number_of_faults() == 1u);
  // Its half-edges say that they are of a face whose boundary is elsewhere.
  for (const auto open : {h, mesh.opposite(own)})
    mesh.set_face(open, F(0));
  BOOST_TEST(validate(mesh).inconsistent_halfedges.size() == 2u);
}

BOOST_AUTO_TEST_CASE(corners_that_are_no_points) {
  auto soup = soup_of(meshes::tetrahedron());
  soup.corners[5] = 70000000;
  BOOST_CHECK_THROW(validate_soup(soup), haptic_sculpt::Error);
  BOOST_CHECK_THROW(haptic_sculpt::make_surface<Mesh>(soup), haptic_sculpt::Error);
  BOOST_CHECK_THROW(haptic_sculpt::orient_components(soup), haptic_sculpt::Error);
}

// Nothing is read beyond the end of a list, whatever is written into it.
BOOST_AUTO_TEST_CASE(faces_that_are_no_parts_of_the_corners_and_names_that_are_too_few_are_refused) {
  using Indices = std::vector<haptic_sculpt::Face_soup::Index>;
  const auto whole = soup_of(meshes::tetrahedron());
  for (const Indices& first :
       {Indices{0, 3, 6, 9, 13}, {0, 3, 6, 2, 12}, {1, 3, 6, 9, 12}, {0, 3, 6, 9, 4000000000u}, {7}}) {
    auto soup = whole;
    soup.first_corner = first;
    BOOST_CHECK_THROW(validate_soup(soup), haptic_sculpt::Error);
    BOOST_CHECK_THROW(haptic_sculpt::make_surface<Mesh>(soup), haptic_sculpt::Error);
    BOOST_CHECK_THROW(haptic_sculpt::orient_components(soup), haptic_sculpt::Error);
  }
  for (const Indices& names : {Indices{7}, {1, 2, 3, 4, 5}})
    BOOST_CHECK_THROW(validate_soup(whole, 0, 1, names), haptic_sculpt::Error);
  BOOST_TEST(validate_soup(whole, 0, 1, {4, 3, 2, 1}).is_valid());
}

BOOST_AUTO_TEST_SUITE_END()
