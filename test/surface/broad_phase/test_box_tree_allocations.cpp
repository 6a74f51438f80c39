// SPDX-License-Identifier: GPL-3.0-or-later
#include "../examples/count_allocations.h"
#include "surface/broad_phase/random_points.h"
#include "surface/broad_phase/swept_faces.h"

#include <haptic_sculpt/surface/broad_phase/Box_tree_broad_phase.h>
#include <haptic_sculpt/surface/connectivity/star.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

using namespace haptic_sculpt;
using namespace broad_phase_tests;

BOOST_AUTO_TEST_CASE(neither_queries_nor_moves_allocate) {
  Mesh mesh = meshes::to_mesh(meshes::torus(60, 30));
  Random random(seed());
  Box_tree_broad_phase<Mesh> tree(mesh);
  for (int k = 0; k < 100; ++k) { // so that there is an overflow too
    const Face_index f(static_cast<Mesh::size_type>(random() % mesh.num_faces()));
    const Halfedge_index h = CGAL::Euler::add_center_vertex(mesh.halfedge(f), mesh);
    mesh.point(mesh.target(h)) = mesh.point(mesh.source(h));
    std::vector<Face_index> around(mesh.faces_around_target(h).begin(), mesh.faces_around_target(h).end());
    tree.faces_inserted(around);
  }
  std::vector<Face_index> found;
  internal::Star<Mesh> star;
  std::size_t before = 0;
  for (int round = 0; round < 2; ++round) { // the same twice: the first warms up
    Random script(haptic_sculpt::test::seed_from_environment(17));
    before = allocations_so_far;
    for (int k = 0; k < 500; ++k) {
      const Vertex_index v(static_cast<Mesh::size_type>(script() % mesh.num_vertices()));
      star.collect(mesh, v);
      const Coordinates s = vertex_coordinates(mesh, v), t = random_point(script, 2);
      found.clear();
      tree.query_star(star.swept(s, t), found);
      tree.query(star.swept(s, s).box(), found);
      mesh.point(v) = Point_3(t[0], t[1], t[2]);
      tree.faces_moved(star.faces);
      mesh.point(v) = Point_3(s[0], s[1], s[2]);
      tree.faces_moved(star.faces);
    }
  }
  BOOST_TEST(allocations_so_far == before);
  BOOST_TEST(before > 0u);
}
