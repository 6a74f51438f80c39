// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_EIGEN3_ENABLED
#define CGAL_EIGEN3_ENABLED // CGAL asks for it before it solves by Eigen
#endif

#include "guard_for_cgal/Comparison.h"

#include <haptic_sculpt/sculpting/Allow_embedded_move.h>
#include <haptic_sculpt/sculpting/guarded_point_map.h>
#include <haptic_sculpt/sculpting/move_vertices.h>

#include <CGAL/Polygon_mesh_processing/angle_and_area_smoothing.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Polygon_mesh_processing/random_perturbation.h>
#include <CGAL/Polygon_mesh_processing/smooth_shape.h>
#include <CGAL/Polygon_mesh_processing/tangential_relaxation.h>
#include <CGAL/Polygon_mesh_processing/transform.h>
#include <CGAL/Surface_mesh_deformation.h>

namespace haptic_sculpt::benchmark {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

/// Runs the function on one mesh in each of the ways in which it can be guarded.
class Function_comparison {
public:
  Function_comparison(const Named_mesh& scene, const Settings& settings, const Tell& tell)
      : scene_(scene), settings_(settings), tell_(tell) {}

  /// \param function `function(mesh, map)`: writes points through the map
  template <class Function>
  void by_map(const std::string& name, const Function& function) {
    if (!settings_.wants(name))
      return;
    begin(name, "map", [&](Mesh& mesh) { return function(mesh, get(CGAL::vertex_point, mesh)); });
    Mesh mesh = scene_.mesh;
    guarded(mesh, [&](Sculptor<Mesh>& sculptor) {
      const auto map = guarded_point_map(sculptor);
      comparison_.guarded.failed = !function(mesh, map);
      comparison_.asked = map.counts().puts;
      comparison_.refused = map.refused();
      comparison_.share = map.counts().asked > 0 ? 1 - map.counts().left / map.counts().asked : 1;
    });
  }

  /// \param function `function(mesh, allow)`: asks before each move
  template <class Plain, class Function>
  void by_functor(const std::string& name, const Plain& plain, const Function& function) {
    if (!settings_.wants(name))
      return;
    begin(name, "functor", plain);
    Mesh mesh = scene_.mesh;
    guarded(mesh, [&](Sculptor<Mesh>& sculptor) {
      const auto allow = allow_embedded_move(sculptor, mesh);
      comparison_.guarded.failed = !function(mesh, allow);
      comparison_.refused = allow.refused();
    });
  }

  /// \param function `function(mesh)`: its result is where the vertices are to go
  template <class Function>
  void by_targets(const std::string& name, const Function& function, bool has_to_arrive = false) {
    if (!settings_.wants(name))
      return;
    const Mesh result = begin(name, "targets", function);
    comparison_.has_to_arrive = has_to_arrive;
    Mesh mesh = scene_.mesh;
    guarded(mesh, [&](Sculptor<Mesh>& sculptor) {
      comparison_.guarded.seconds = comparison_.plain.seconds; // the function has to be called first
      Move_parameters parameters;
      if (std::isfinite(settings_.drags_a_vertex))
        parameters.most_drags(static_cast<std::size_t>(settings_.drags_a_vertex * mesh.number_of_vertices()));
      const Move_report report = move_vertices(sculptor, mesh.vertices(), get(CGAL::vertex_point, result), parameters);
      comparison_.drags = report.drags;
      comparison_.out_of_work = report.out_of_work;
      comparison_.asked = report.asked;
      comparison_.refused = report.asked - report.reached;
      comparison_.share = report.asked_l2 > 0 ? 1 - report.left_l2 / report.asked_l2 : 1;
    });
  }

private:
  const Named_mesh& scene_;
  const Settings& settings_;
  const Tell& tell_;
  Comparison comparison_;

  template <class Function>
  Mesh begin(const std::string& name, const std::string& way, const Function& function) {
    comparison_ = Comparison();
    comparison_.mesh = scene_.name;
    comparison_.function = name;
    comparison_.way = way;
    Mesh mesh = scene_.mesh;
    const auto start = std::clock();
    comparison_.plain.failed = !function(mesh);
    comparison_.plain.seconds = seconds_since(start);
    measure(mesh, mean_edge(scene_.mesh), nullptr, comparison_.plain);
    return mesh;
  }

  template <class Work>
  void guarded(Mesh& mesh, const Work& work) {
    auto start = std::clock();
    Sculptor<Mesh> sculptor(mesh);
    comparison_.set_up = seconds_since(start);
    const test::Mesh_snapshot before = test::snapshot(sculptor);
    start = std::clock();
    {
      const auto stroke = sculptor.stroke();
      work(sculptor);
    }
    comparison_.guarded.seconds += seconds_since(start);
    measure(mesh, mean_edge(scene_.mesh), nullptr, comparison_.guarded);
    undo_and_redo(sculptor, before, comparison_);
    tell_(comparison_);
  }
};

/// The vertices of a third of the mesh, along its longest extent: the middle one.
std::vector<Vertex_index> middle_third(const Mesh& mesh) {
  const auto box = PMP::bbox(mesh);
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    axis = box.max(i) - box.min(i) > box.max(axis) - box.min(axis) ? i : axis;
  const double third = (box.max(axis) - box.min(axis)) / 3;
  std::vector<Vertex_index> vertices;
  for (const Vertex_index v : mesh.vertices())
    if (mesh.point(v)[axis] > box.min(axis) + third && mesh.point(v)[axis] < box.max(axis) - third)
      vertices.push_back(v);
  return vertices;
}

/// Its ends along the longest extent are turned against each other by half a turn.
bool twist_by_arap(Mesh& mesh) {
  const auto box = PMP::bbox(mesh);
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    axis = box.max(i) - box.min(i) > box.max(axis) - box.min(axis) ? i : axis;
  const double tenth = (box.max(axis) - box.min(axis)) / 10;
  const Mesh input = mesh;
  CGAL::Surface_mesh_deformation<Mesh> deformation(mesh);
  deformation.insert_roi_vertices(vertices(mesh).begin(), vertices(mesh).end());
  std::vector<Vertex_index> turned, all;
  for (const Vertex_index v : mesh.vertices()) {
    const bool is_low =
        input.point(v)[axis]<box.min(axis) + tenth, is_high = input.point(v)[axis]> box.max(axis) - tenth;
    if (is_high)
      turned.push_back(v);
    if (is_low || is_high)
      all.push_back(v);
  }
  deformation.insert_control_vertices(all.begin(), all.end());
  if (!deformation.preprocess())
    return false;
  const Point_3 middle((box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2);
  for (const Vertex_index v : turned) {
    std::array<double, 3> p = {input.point(v).x(), input.point(v).y(), input.point(v).z()};
    for (const int i : {(axis + 1) % 3, (axis + 2) % 3})
      p[i] = 2 * middle[i] - p[i];
    deformation.set_target_position(v, Point_3(p[0], p[1], p[2]));
  }
  deformation.deform(10, 0);
  return true;
}

} // namespace

void compare_functions(const Named_mesh& scene, const Settings& settings, const Tell& tell) {
  Function_comparison compare(scene, settings, tell);
  const auto relaxed = params::number_of_iterations(5);
  compare.by_map("tangential_relaxation", [&](Mesh& mesh, const auto& map) {
    PMP::tangential_relaxation(mesh, relaxed.vertex_point_map(map));
    return true;
  });
  compare.by_functor(
      "tangential_relaxation", [&](Mesh& mesh) { return PMP::tangential_relaxation(mesh, relaxed), true; },
      [&](Mesh& mesh, const auto& allow) {
        return PMP::tangential_relaxation(mesh, relaxed.allow_move_functor(allow)), true;
      });
  compare.by_map("angle_and_area_smoothing", [](Mesh& mesh, const auto& map) {
    // By angle; by area it needs Ceres.
    PMP::angle_and_area_smoothing(mesh, params::number_of_iterations(3)
                                            .use_area_smoothing(false)
                                            .use_Delaunay_flips(false)
                                            .use_safety_constraints(false)
                                            .vertex_point_map(map));
    return true;
  });
  compare.by_map("fair", [](Mesh& mesh, const auto& map) {
    return PMP::fair(mesh, middle_third(mesh), params::vertex_point_map(map));
  });
  const double edge = mean_edge(scene.mesh);
  compare.by_map("random_perturbation", [&](Mesh& mesh, const auto& map) {
    PMP::random_perturbation(vertices(mesh), mesh, 0.5 * edge,
                             params::vertex_point_map(map).do_project(false).random_seed(settings.seed));
    return true;
  });
  compare.by_targets("smooth_shape", [&](Mesh& mesh) {
    PMP::smooth_shape(mesh, edge * edge, params::number_of_iterations(3));
    return true;
  });
  const auto turn = [](Mesh& mesh) { // exact: coordinates change places
    PMP::transform(CGAL::Aff_transformation_3<meshes::Kernel>(0, -1, 0, 1, 0, 0, 0, 0, 1), mesh);
    return true;
  };
  compare.by_targets("transform, a right angle", turn, true);
  compare.by_targets("Surface_mesh_deformation, half a twist", twist_by_arap);
}

} // namespace haptic_sculpt::benchmark
