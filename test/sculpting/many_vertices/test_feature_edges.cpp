// SPDX-License-Identifier: GPL-3.0-or-later
// Edges that are constrained because they are sharp.
#include "sculpting/many_vertices/many_vertices_scene.h"

#include <haptic_sculpt/sculpting/isotropic_remeshing.h>

#include <random>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Edge_marks = Mesh::Property_map<Edge_index, bool>;

/// The edges sharper than an angle, in degrees.
std::vector<Edge_index> sharp_edges(Mesh& mesh, double angle, double length = 0.3) {
  const Edge_marks marks = mesh.add_property_map<Edge_index, bool>("e:sharp", false).first;
  Sculptor<Mesh> sculptor(mesh);
  const auto np = CGAL::parameters::number_of_iterations(0).edge_is_constrained_map(marks);
  isotropic_remeshing(sculptor, length, np, Remeshing_parameters().feature_angle(angle));
  std::vector<Edge_index> result;
  std::copy_if(mesh.edges().begin(), mesh.edges().end(), std::back_inserter(result), [&](auto e) { return marks[e]; });
  return result;
}

} // namespace

// More than the angle, not as much: the cosine of a right angle is no 0 in doubles.
BOOST_AUTO_TEST_CASE(the_edges_of_a_cube_are_features_below_a_right_angle) {
  for (const double angle : {0.0, 1e-3, 89.99, 90.0, 90.01}) {
    Mesh mesh = meshes::to_mesh(meshes::box(3));
    const std::size_t marked = sharp_edges(mesh, angle).size();
    BOOST_TEST(marked == (angle < 90 ? 36u : 0u), marked << " edges beyond " << angle << " degrees");
  }
}

// A prism whose base has a vertex some last places from an edge: the needle between them is so thin that its normal, in
// doubles, is anything. It lies in the base all the same.
BOOST_AUTO_TEST_CASE(needles_beside_a_crease_hide_none) {
  std::mt19937_64 random(seed_from_environment(37));
  std::uniform_real_distribution<double> number(-1, 1);
  std::size_t vanishing = 0; // normals that are 0 in doubles
  for (int n = 0; n < 300; ++n) {
    const double slope = number(random), along = 0.5 + 0.4 * number(random);
    const int exponent = n % 3 == 0 ? 0 : static_cast<int>(300 * number(random));
    const std::array<double, 2> a = {0, 0}, b = {10, slope}, d = {10, slope + 10}, e = {0, 10};
    std::array<double, 2> c = {10 * along, slope * along};
    const auto is_left = [&] {
      using Point_2 = meshes::Kernel::Point_2;
      return CGAL::orientation(Point_2(a[0], a[1]), Point_2(b[0], b[1]), Point_2(c[0], c[1])) == CGAL::LEFT_TURN;
    };
    while (!is_left())
      c[1] = std::nextafter(c[1], 10);
    meshes::Triangle_list list;
    for (const double z : {0.0, 10.0})
      for (const auto& p : {a, b, d, e, c}) {
        std::array<double, 3> q;
        q[n % 3] = std::ldexp(p[0], exponent), q[(n + 1) % 3] = std::ldexp(p[1], exponent),
              q[(n + 2) % 3] = std::ldexp(z, exponent);
        if (list.points.size() < 9) // the top has no vertex in it
          list.points.emplace_back(q[0], q[1], q[2]);
      }
    list.faces = {{0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}, {5, 6, 7}, {5, 7, 8}};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t next = (k + 1) % 4;
      list.faces.push_back({k, next, 5 + next}), list.faces.push_back({k, 5 + next, 5 + k});
    }
    Mesh mesh = meshes::to_mesh(list);
    vanishing += (b[0] - a[0]) * (c[1] - a[1]) == (b[1] - a[1]) * (c[0] - a[0]);
    const auto sharp = sharp_edges(mesh, 30, std::ldexp(1, exponent));
    BOOST_TEST(sharp.size() == 12u);
    for (const Edge_index edge : sharp)
      BOOST_TEST((mesh.vertex(edge, 0) != Vertex_index(4) && mesh.vertex(edge, 1) != Vertex_index(4)));
  }
  BOOST_TEST(vanishing > 30u);
}
