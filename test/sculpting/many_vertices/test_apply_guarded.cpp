// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of CGAL's that move all points at once, each by one line under the guard, against what they make alone.
#ifndef CGAL_EIGEN3_ENABLED
#define CGAL_EIGEN3_ENABLED // CGAL asks for it before it solves by Eigen
#endif

#include "sculpting/many_vertices/many_vertices_scene.h"

#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Polygon_mesh_processing/smooth_shape.h>
#include <CGAL/Polygon_mesh_processing/transform.h>
#include <CGAL/Surface_mesh_deformation.h>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

/// Runs a function alone and under the guard. \return what the guard says
template <class Function>
Move_report alone_and_guarded(const std::string& name, const Mesh& input, const Function& function) {
  Mesh alone = input, mesh = input;
  function(alone, get(CGAL::vertex_point, alone));
  Sculptor<Mesh> sculptor(mesh);
  const Mesh_snapshot before = snapshot(sculptor);
  std::vector<Vertex_index> behind;
  const Move_report report = apply_guarded(sculptor, function, Move_parameters(), std::back_inserter(behind));
  std::size_t moved = 0, reached = 0;
  for (const Vertex_index v : input.vertices()) {
    moved += alone.point(v) != input.point(v);
    reached += alone.point(v) != input.point(v) && mesh.point(v) == alone.point(v);
    BOOST_TEST((alone.point(v) != input.point(v) || mesh.point(v) == input.point(v)));
  }
  BOOST_TEST_MESSAGE(name << ": " << reached << " of " << moved << " vertices arrive; alone "
                          << validate(alone).intersecting_faces.size() << " pairs");
  BOOST_TEST(moved > 0u, name);
  BOOST_TEST(report.asked == moved, name);
  BOOST_TEST(report.reached == reached, name);
  BOOST_TEST(behind.size() == moved - reached, name);
  BOOST_TEST(validate(mesh).is_valid(), name);
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 1u, name);
  check_undo_and_redo(sculptor, before);
  return report;
}

} // namespace

BOOST_AUTO_TEST_CASE(functions_of_cgal_go_as_they_want_where_nothing_is_in_the_way) {
  const Mesh ball = meshes::to_mesh(meshes::bumpy_sphere(3, 0.2));
  const auto fair = alone_and_guarded("fair", ball, [](auto& mesh, auto map) {
    std::vector<Vertex_index> upper;
    for (const Vertex_index v : mesh.vertices())
      if (mesh.point(v).z() > 0.6)
        upper.push_back(v);
    return PMP::fair(mesh, upper, params::vertex_point_map(map));
  });
  BOOST_TEST(fair.reached == fair.asked);
  const auto shape = alone_and_guarded("smooth_shape", ball, [](auto& mesh, auto map) {
    PMP::smooth_shape(mesh, 0.001, params::number_of_iterations(2).vertex_point_map(map));
  });
  BOOST_TEST(shape.reached == shape.asked);
  const auto turn = alone_and_guarded("transform", ball, [](auto& mesh, auto map) {
    PMP::transform(CGAL::Aff_transformation_3<meshes::Kernel>(0, -1, 0, 1, 0, 0, 0, 0, 1), mesh,
                   params::vertex_point_map(map));
  });
  BOOST_TEST(turn.reached == turn.asked);
}

// A ring whose one end is drawn through the other: alone it crosses itself.
BOOST_AUTO_TEST_CASE(deformation_that_crosses_itself_is_stopped) {
  const Mesh ring = meshes::to_mesh(meshes::torus(40, 12));
  const auto report = alone_and_guarded("Surface_mesh_deformation", ring, [](Mesh& mesh, auto) {
    std::vector<Vertex_index> pulled, held;
    for (const Vertex_index v : mesh.vertices()) {
      if (mesh.point(v).x() > 1.1)
        pulled.push_back(v);
      else if (mesh.point(v).x() < -0.9)
        held.push_back(v);
    }
    CGAL::Surface_mesh_deformation<Mesh> deformation(mesh); // writes the points of the copy itself
    deformation.insert_roi_vertices(mesh.vertices().begin(), mesh.vertices().end());
    deformation.insert_control_vertices(pulled.begin(), pulled.end());
    deformation.insert_control_vertices(held.begin(), held.end());
    BOOST_TEST(deformation.preprocess());
    deformation.translate(pulled.begin(), pulled.end(), Vector_3(-2.4, 0, 0));
    deformation.deform(10, 0);
  });
  BOOST_TEST(report.reached < report.asked);
  BOOST_TEST(report.left_l2 < 0.9 * report.asked_l2);
}

// Nobody arrives on the line, and there is no end of coming nearer to it: passes of axis moves end, too.
BOOST_AUTO_TEST_CASE(coming_nearer_to_the_origin_ends) {
  for (const double share : {1.0, 1e-320}) {
    Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(1, 0.12));
    Sculptor<Mesh> sculptor(mesh);
    const auto flatten = [share](Mesh& copy, auto points) {
      for (const Vertex_index v : copy.vertices())
        put(points, v, Point_3(get(points, v).x(), share * get(points, v).y() * (share < 1), 0));
    };
    const Move_report report = apply_guarded(sculptor, flatten);
    BOOST_TEST(report.reached < report.asked);
    BOOST_TEST(report.left_max < 0x1p-90);
    BOOST_TEST(report.drags < 20000u);
    BOOST_TEST(validate(mesh).is_valid());
  }
}

BOOST_AUTO_TEST_CASE(functions_that_fail_or_do_more_than_move_points_change_nothing) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.2));
  Sculptor<Mesh> sculptor(mesh);
  const Mesh_snapshot before = snapshot(sculptor);
  BOOST_TEST(apply_guarded(sculptor, [](Mesh& copy, auto map) {
               put(map, *copy.vertices().begin(), Point_3(0, 0, 0));
               return false;
             }).asked == 0u);
  BOOST_CHECK_THROW(
      apply_guarded(sculptor,
                    [](Mesh& copy, auto) { CGAL::Euler::flip_edge(copy.halfedge(*copy.edges().begin()), copy); }),
      Invalid_parameter);
  BOOST_CHECK_THROW(apply_guarded(sculptor, [](Mesh& copy, auto) { copy.add_vertex(Point_3(5, 5, 5)); }),
                    Invalid_parameter);
  BOOST_CHECK_THROW(apply_guarded(sculptor, [](Mesh& copy, auto) { copy.clear(); }), Invalid_parameter);
  BOOST_CHECK_THROW(
      apply_guarded(sculptor, [](Mesh&, auto map) { put(map, Vertex_index(7), Point_3(std::nan(""), 0, 0)); }),
      Out_of_range);
  BOOST_CHECK_THROW(apply_guarded(sculptor, [](Mesh&, auto) { throw std::runtime_error("of the caller's"); }),
                    std::runtime_error);
  BOOST_TEST(apply_guarded(sculptor, [](Mesh&, auto) {}).asked == 0u);
  BOOST_TEST((snapshot(sculptor) == before));
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 0u);
  sculptor.check_unchanged();
}

BOOST_AUTO_TEST_CASE(the_copy_may_be_another_mesh_with_the_same_connectivity) {
  for (const bool swaps : {false, true}) {
    Mesh mesh = meshes::to_mesh(meshes::icosphere(1)), wanted = mesh;
    wanted.point(Vertex_index(3)) = CGAL::ORIGIN + 1.25 * (wanted.point(Vertex_index(3)) - CGAL::ORIGIN);
    const Mesh::Point end = wanted.point(Vertex_index(3));
    Sculptor<Mesh> sculptor(mesh);
    const Move_report report = apply_guarded(sculptor, [&](Mesh& copy, auto) {
      if (swaps)
        std::swap(copy, wanted);
      else
        copy = wanted;
    });
    BOOST_TEST(report.reached == 1u);
    BOOST_TEST((mesh.point(Vertex_index(3)) == end));
  }
}
