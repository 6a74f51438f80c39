// SPDX-License-Identifier: GPL-3.0-or-later
#include <haptic_sculpt/surface/repair/Work_mesh.h>

#include <CGAL/boost/graph/generators.h>

#include <boost/test/unit_test.hpp>

// A walk around a vertex whose border is not there.
BOOST_AUTO_TEST_CASE(walks_along_half_edges_end) {
  using Mesh = haptic_sculpt::internal::Work_mesh;
  Mesh mesh;
  CGAL::make_tetrahedron(Mesh::Point(0, 0, 0), Mesh::Point(1, 0, 0), Mesh::Point(0, 1, 0), Mesh::Point(0, 0, 1), mesh);
  auto h = *mesh.halfedges().begin();
  BOOST_CHECK_THROW(while (!is_border(h, mesh)) h = opposite(next(h, mesh), mesh), CGAL::Failure_exception);
}
