// SPDX-License-Identifier: GPL-3.0-or-later
#include <haptic_sculpt/surface/connectivity/star.h>
#include <meshes/generated_meshes.h>

#include <boost/test/unit_test.hpp>

using meshes::Mesh;

BOOST_AUTO_TEST_SUITE(star)

// Named by CGAL's own search round the centre.
BOOST_AUTO_TEST_CASE(spokes_lead_from_the_link_to_the_centre) {
  std::size_t seen = 0;
  haptic_sculpt::internal::Star<Mesh> star;
  for (const auto& surface : {meshes::tetrahedron(), meshes::torus(7, 5), meshes::bumpy_sphere(1, 0.1)}) {
    const Mesh mesh = meshes::to_mesh(surface);
    for (const Mesh::Vertex_index v : mesh.vertices()) {
      star.collect(mesh, v);
      BOOST_TEST(star.valence() == mesh.degree(v));
      for (std::size_t i = 0; i < star.valence(); ++i, ++seen) {
        const Mesh::Halfedge_index h = star.spoke(mesh, i);
        BOOST_TEST((h == mesh.halfedge(star.link[i], v)));
        BOOST_TEST((mesh.face(h) == star.faces[i]));
      }
    }
  }
  BOOST_TEST(seen > 300u);
}

BOOST_AUTO_TEST_SUITE_END()
