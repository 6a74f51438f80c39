// SPDX-License-Identifier: GPL-3.0-or-later
// Guarded remeshing of what is very large or very small: the same as of what is of size one.
#include "sculpting/many_vertices/many_vertices_scene.h"

#include <haptic_sculpt/sculpting/isotropic_remeshing.h>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

Mesh octahedron() {
  meshes::Triangle_list list = meshes::bipyramid(4);
  return meshes::to_mesh(list);
}

Mesh scaled(Mesh mesh, int exponent) {
  for (const auto v : mesh.vertices()) {
    const Point_3 p = mesh.point(v);
    mesh.point(v) =
        Point_3(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent));
  }
  return mesh;
}

/// Remeshed twice: to shorter edges, then to longer ones.
Mesh remeshed(Mesh mesh, int exponent, double length, double angle) {
  Sculptor<Mesh> sculptor(mesh);
  for (const double factor : {1.0, 1.9})
    isotropic_remeshing(sculptor, std::ldexp(factor * length, exponent), CGAL::parameters::number_of_iterations(2),
                        Remeshing_parameters().feature_angle(angle).max_distance(std::ldexp(0.7 * length, exponent)));
  return mesh;
}

bool is_same(const Mesh& a, const Mesh& b) {
  if (a.num_vertices() != b.num_vertices() || a.num_faces() != b.num_faces())
    return false;
  for (Vertex_index v(0); static_cast<std::size_t>(v) < a.num_vertices(); ++v)
    if (a.is_removed(v) != b.is_removed(v) || (!a.is_removed(v) && a.point(v) != b.point(v)))
      return false;
  for (Face_index f(0); static_cast<std::size_t>(f) < a.num_faces(); ++f)
    if (a.is_removed(f) != b.is_removed(f) ||
        (!a.is_removed(f) && internal::corners_of_face(a, f) != internal::corners_of_face(b, f)))
      return false;
  return true;
}

/// From here on no coordinate of the results, zero but for roundings of them included, is subnormal.
constexpr int least_plain_exponent = -850;

void check(const Mesh& mesh, double length, double angle, int step) {
  const Mesh expected = remeshed(mesh, 0, length, angle);
  BOOST_TEST(expected.number_of_faces() != mesh.number_of_faces());
  for (int exponent = -1000; exponent < 1000; exponent += step) {
    const Mesh result = remeshed(scaled(mesh, exponent), exponent, length, angle);
    BOOST_TEST_CONTEXT("2^" << exponent) {
      BOOST_TEST(validate(result).is_valid());
      if (exponent >= least_plain_exponent)
        BOOST_TEST(is_same(result, scaled(expected, exponent)));
    }
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(powers_of_two_change_no_bit) {
  check(octahedron(), 0.5, 180, 7);
  check(meshes::to_mesh(meshes::bumpy_sphere(2)), 0.2, 180, 111);
  check(meshes::to_mesh(meshes::box(3)), 0.25, 30, 111);
}

BOOST_AUTO_TEST_CASE(the_largest_and_the_smallest) {
  // Of side 2^1000, and of a few smallest doubles.
  for (const int exponent : {1000, -1064, -1070}) {
    const Mesh cube = scaled(meshes::to_mesh(meshes::box(2)), exponent);
    for (const double share : {0.3, 1.0}) {
      Mesh mesh = cube;
      Sculptor<Mesh> sculptor(mesh);
      isotropic_remeshing(sculptor, std::ldexp(share, exponent), CGAL::parameters::number_of_iterations(2));
      BOOST_TEST(validate(mesh).is_valid());
    }
  }
  // Lengths that have nothing to do with the mesh.
  for (const int exponent : {-900, 0, 900}) {
    const Mesh cube = scaled(meshes::to_mesh(meshes::box(2)), exponent);
    for (const double length : {0x1p-1074, 0x1p-1000, 1.0, 0x1p1000}) {
      Mesh mesh = cube;
      Sculptor<Mesh> sculptor(mesh);
      if (std::ldexp(1, exponent) > 1e9 * length) {
        const Mesh_snapshot before = snapshot(sculptor);
        BOOST_CHECK_THROW(isotropic_remeshing(sculptor, length), Invalid_parameter);
        BOOST_TEST((snapshot(sculptor) == before));
      } else {
        isotropic_remeshing(sculptor, length, CGAL::parameters::number_of_iterations(2));
      }
      BOOST_TEST(validate(mesh).is_valid());
    }
  }
}

// Edges on the border of a range stay, and constrained ones that are protected, however long they are. Splits beside
// them end, and leave no slivers.
BOOST_AUTO_TEST_CASE(beside_edges_that_stay_splits_end) {
  const auto smallest_angle = [](const Mesh& mesh) {
    double smallest = 180;
    for (const auto h : mesh.halfedges())
      smallest = std::fmin(smallest, CGAL::approximate_angle(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                                             mesh.point(mesh.target(mesh.next(h)))));
    return smallest;
  };
  const Mesh ball = meshes::to_mesh(meshes::bumpy_sphere(2, 0.2, 0.1));
  const double smallest_at_first = smallest_angle(ball);
  std::size_t splits = 0;
  for (std::size_t k = 0; k < 60; ++k) {
    BOOST_TEST_INFO_SCOPE("run " << k);
    Mesh mesh = ball;
    Sculptor<Mesh> sculptor(mesh);
    const bool protects = k % 2 == 0;
    const double length = (protects ? 3 : 1) * (k % 3 == 0 ? 0.02 : k % 3 == 1 ? 0.05 : 0.09);
    const Point_3 centre = mesh.point(Vertex_index(static_cast<unsigned>(7 * k % mesh.num_vertices())));
    std::vector<Face_index> range;
    for (const Face_index f : mesh.faces())
      if (protects || CGAL::squared_distance(mesh.point(mesh.target(mesh.halfedge(f))), centre) < 0.1)
        range.push_back(f);
    const auto marks = mesh.add_property_map<Mesh::Edge_index, bool>("e:constrained", false).first;
    for (const auto e : mesh.edges())
      marks[e] = protects && static_cast<std::size_t>(e) % 11 == k % 11;
    const auto np = CGAL::parameters::number_of_iterations(3).edge_is_constrained_map(marks).protect_constraints(true);
    const auto report = isotropic_remeshing(range, sculptor, length, np, Remeshing_parameters().most_faces(100000));
    splits += report.splits.done;
    BOOST_TEST(report.splits.refused == 0u);
    BOOST_TEST(smallest_angle(mesh) >= std::fmin(5, smallest_at_first / 2));
    BOOST_TEST(validate(mesh).is_valid());
  }
  BOOST_TEST(splits > 1000u);
}

BOOST_AUTO_TEST_CASE(a_number_of_faces_bounds_the_work) {
  const Mesh cube = meshes::to_mesh(meshes::box(1));
  Mesh mesh = cube;
  Sculptor<Mesh> sculptor(mesh);
  const Mesh_snapshot before = snapshot(sculptor);
  // 6 sides of 10^2 edges each: that many triangles, at the very least.
  BOOST_CHECK_THROW(isotropic_remeshing(sculptor, 0.1, CGAL::parameters::default_values(),
                                        Remeshing_parameters().most_faces(600)),
                    Invalid_parameter);
  BOOST_TEST((snapshot(sculptor) == before));
  // More than at the least, and fewer than without a bound.
  const Remeshing_report report = isotropic_remeshing(sculptor, 0.1, CGAL::parameters::number_of_iterations(3),
                                                      Remeshing_parameters().most_faces(900));
  BOOST_TEST(report.splits.refused > 0u);
  BOOST_TEST(mesh.number_of_faces() <= 900u);
  BOOST_TEST(mesh.number_of_faces() > 600u);
  BOOST_TEST(validate(mesh).is_valid());
  // Nothing is to be split, so fewer faces may come of more.
  isotropic_remeshing(sculptor, 1, CGAL::parameters::default_values(), Remeshing_parameters().most_faces(100));
  BOOST_TEST(mesh.number_of_faces() < 100u);
  // A needle as long as 10^5 lengths and 10^-4 of one thick.
  meshes::Triangle_list needle;
  needle.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}, {0.5, 0, 1e-9}};
  needle.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  Mesh thin = meshes::to_mesh(needle);
  Sculptor<Mesh> thin_sculptor(thin);
  BOOST_CHECK_THROW(isotropic_remeshing(thin_sculptor, 1e-5, CGAL::parameters::default_values(),
                                        Remeshing_parameters().most_faces(100000)),
                    Invalid_parameter);
}

// In the unit of such a length the squares of edges would overflow. Nothing is as short: it does not matter how short.
BOOST_AUTO_TEST_CASE(a_length_that_nothing_is_divided_by_may_be_any) {
  const auto remeshed = [](double length) {
    Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2));
    Sculptor<Mesh> sculptor(mesh);
    const Remeshing_report report =
        isotropic_remeshing(sculptor, length, CGAL::parameters::do_split(false).number_of_iterations(2),
                            Remeshing_parameters().max_distance(0.01).feature_angle(60));
    BOOST_TEST(validate(mesh).is_valid());
    BOOST_TEST(report.moves.done > 0u);
    return snapshot(sculptor);
  };
  const Mesh_snapshot usual = remeshed(1e-5);
  for (const double length : {1e-60, 1e-100, 1e-120, 1e-300})
    BOOST_TEST((remeshed(length) == usual));
  for (const double length : {1e60, 1e300}) {
    Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2));
    Sculptor<Mesh> sculptor(mesh);
    const Remeshing_report report = isotropic_remeshing(sculptor, length, CGAL::parameters::do_collapse(false));
    BOOST_TEST(report.moves.done > 0u);
    BOOST_TEST(validate(mesh).is_valid());
  }
}

// A face with a border that is too long, and stays, counts for nothing.
BOOST_AUTO_TEST_CASE(a_length_too_short_is_refused_for_edges_that_may_be_split) {
  Mesh mesh = meshes::to_mesh(meshes::icosphere(1));
  Sculptor<Mesh> sculptor(mesh);
  const std::vector<Face_index> all(mesh.faces().begin(), mesh.faces().end());
  const auto few = Remeshing_parameters().most_faces(100);
  std::vector<Face_index> some{all[0]};
  BOOST_TEST(isotropic_remeshing(some, sculptor, 1e-6, CGAL::parameters::default_values(), few).splits.done == 0u);
  some.push_back(mesh.face(mesh.opposite(mesh.halfedge(all[0])))); // an edge between them, and the border stays
  BOOST_TEST(isotropic_remeshing(some, sculptor, 1e-6, CGAL::parameters::default_values(), few).splits.done <= 1u);
  for (const std::size_t left_out : {0, 1}) { // most of which are not at the border
    const std::vector<Face_index> most(all.begin() + left_out, all.end());
    BOOST_CHECK_THROW(isotropic_remeshing(most, sculptor, 1e-6, CGAL::parameters::default_values(), few),
                      Invalid_parameter);
  }
  BOOST_CHECK_THROW(
      isotropic_remeshing(sculptor, 1, CGAL::parameters::default_values(), Remeshing_parameters().max_distance(1e305)),
      Out_of_range);
}

BOOST_AUTO_TEST_CASE(a_face_given_twice_counts_once) {
  const auto remeshed = [](std::size_t times) {
    Mesh mesh = meshes::to_mesh(meshes::icosphere(1));
    Sculptor<Mesh> sculptor(mesh);
    std::vector<Mesh::Face_index> faces;
    for (std::size_t k = 0; k < times; ++k)
      faces.insert(faces.end(), mesh.faces().begin(), mesh.faces().end());
    isotropic_remeshing(faces, sculptor, 0.4);
    return snapshot(sculptor);
  };
  BOOST_TEST((remeshed(1) == remeshed(3)));
}
