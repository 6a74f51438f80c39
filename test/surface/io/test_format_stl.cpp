// SPDX-License-Identifier: GPL-3.0-or-later
#include <haptic_sculpt/surface/write_surface.h>

#include <meshes/generated_meshes.h>

#include <CGAL/Cartesian_converter.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

using namespace haptic_sculpt;
using meshes::Mesh;
using V = Mesh::Vertex_index;

BOOST_AUTO_TEST_SUITE(stl_as_written)

/// What `facet normal` says of each triangle, against the cross product in rationals: along it, of length 1.
BOOST_AUTO_TEST_CASE(facet_normals_of_stl_are_right_on_slivers_and_at_every_scale) {
  using Rational = CGAL::Simple_cartesian<CGAL::Exact_rational>;
  const CGAL::Cartesian_converter<meshes::Kernel, Rational> exact;
  constexpr unsigned seed = 60;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937_64 random(seed);
  const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-53 - 0.5; };
  for (const double scale : {1.0, 0x1p1000, 0x1p-1000, 0x1p-530})
    for (int i = 0; i < 20; ++i) {
      Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
      const meshes::Point_3 a(scale * number(), scale * number(), scale * number()),
          b(scale * number(), scale * number(), scale * number());
      mesh.point(V(0)) = a, mesh.point(V(1)) = b;
      mesh.point(V(2)) = CGAL::midpoint(a, b); // on the line, up to rounding
      mesh.point(V(3)) = {scale * number(), scale * number(), scale * number()};
      std::istringstream text(surface_bytes(mesh, Mesh_file_format::stl));
      std::vector<std::array<double, 3>> normals;
      for (std::string word; text >> word;)
        if (word == "normal") {
          std::array<std::string, 3> words; // a stream does not read subnormal numbers
          text >> words[0] >> words[1] >> words[2];
          normals.push_back({std::stod(words[0]), std::stod(words[1]), std::stod(words[2])});
        }
      BOOST_REQUIRE(normals.size() == 4u);
      for (const auto f : mesh.faces()) {
        const auto h = mesh.halfedge(f);
        const auto p = exact(mesh.point(mesh.source(h)));
        const Rational::Vector_3 n = CGAL::cross_product(exact(mesh.point(mesh.target(h))) - p,
                                                         exact(mesh.point(mesh.target(mesh.next(h)))) - p);
        const auto& [x, y, z] = normals[f];
        const Rational::Vector_3 said(x, y, z);
        if (n == CGAL::NULL_VECTOR) {
          BOOST_TEST((said == CGAL::NULL_VECTOR));
          continue;
        }
        BOOST_TEST(std::abs(std::hypot(x, y, z) - 1) < 1e-15);
        BOOST_TEST(n * said > 0);
        const auto across = CGAL::cross_product(n, said);
        BOOST_TEST(across.squared_length() < 1e-30 * n.squared_length());
      }
    }
}

BOOST_AUTO_TEST_SUITE_END()
