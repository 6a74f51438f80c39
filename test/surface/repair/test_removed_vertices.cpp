// SPDX-License-Identifier: GPL-3.0-or-later
// Soups and repairs of meshes with removed vertices.
#include <haptic_sculpt/surface/repair.h>

#include <meshes/generated_meshes.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <string>

using haptic_sculpt::Face_soup;
using haptic_sculpt::repair;
using haptic_sculpt::Repair_report;
using haptic_sculpt::validate_soup;
using meshes::Mesh;
using meshes::Point_3;

BOOST_AUTO_TEST_SUITE(removed_vertices)

// Removed vertices are no points: the others keep their order, and nothing takes the place of what was removed.
BOOST_AUTO_TEST_CASE(points_of_a_mesh_with_garbage_are_named_by_their_rank) {
  for (const double bad : {1e302, std::numeric_limits<double>::quiet_NaN()}) {
    Mesh mesh = meshes::to_mesh(meshes::icosphere(1));
    const auto removed = mesh.add_vertex(Point_3(0, 0, 0));
    const auto v = mesh.add_vertex(Point_3(bad, 0, 0));
    mesh.add_vertex(Point_3(3, 0, 0)), mesh.add_vertex(Point_3(4, 0, 0));
    mesh.remove_vertex(removed);
    const std::size_t rank = static_cast<std::size_t>(v) - 1;
    if (std::isfinite(bad)) {
      BOOST_CHECK_EXCEPTION(repair(mesh), haptic_sculpt::Out_of_range, [&](const haptic_sculpt::Error& error) {
        return std::string(error.what()).find("vertex " + std::to_string(rank) + " at (1e") != std::string::npos;
      });
    } else {
      const Repair_report report = repair(mesh);
      BOOST_REQUIRE(report.left.non_finite_vertices.size() == 1u);
      BOOST_TEST(static_cast<std::size_t>(report.left.non_finite_vertices[0]) == rank);
    }
  }
}

// The memory of what a mesh has removed says nothing: the same mesh is the same soup.
BOOST_AUTO_TEST_CASE(a_soup_of_a_mesh_with_garbage_is_always_the_same) {
  Mesh mesh = meshes::to_mesh(meshes::icosphere(1));
  for (const auto v : {mesh.add_vertex(Point_3(9, 9, 9)), mesh.add_vertex(Point_3(8, 8, 8))})
    mesh.remove_vertex(v);
  for (const int filling : {0xff, 0x7e, 0}) { // of doubles: no numbers, out of range, 0
    const std::size_t size = sizeof(Point_3) * mesh.num_vertices();
    void* const used_before = ::operator new(size);
    std::memset(used_before, filling, size);
    ::operator delete(used_before);
    Face_soup soup = haptic_sculpt::face_soup(mesh);
    for (std::size_t v = mesh.number_of_vertices(); v < soup.points.size(); ++v)
      BOOST_TEST(soup.points[v] == Point_3(0, 0, 0));
    BOOST_TEST(repair(soup).is_repaired());
    BOOST_TEST(validate_soup(haptic_sculpt::face_soup(mesh)).non_finite_vertices.empty());
  }
}

BOOST_AUTO_TEST_SUITE_END()
