// SPDX-License-Identifier: GPL-3.0-or-later
#include "guard_for_cgal/Comparison.h"

#include <haptic_sculpt/sculpting/isotropic_remeshing.h>
#include <haptic_sculpt/sculpting/move_vertices.h>

#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <cstdio>

namespace haptic_sculpt::benchmark {

namespace PMP = CGAL::Polygon_mesh_processing;

void compare_remeshing(const Named_mesh& scene, const Settings& settings, const Tell& tell) {
  for (const double factor : {0.7, 1.0, 1.5, 2.0, 3.0}) {
    Comparison comparison;
    comparison.mesh = scene.name;
    char name[64];
    std::snprintf(name, sizeof name, "isotropic_remeshing, %.1f mean edges", factor);
    comparison.function = name;
    if (!settings.wants(name))
      continue;
    comparison.way = "remesher";
    const double length = factor * mean_edge(scene.mesh);
    const auto np = CGAL::parameters::number_of_iterations(settings.iterations);

    Mesh plain = scene.mesh, guarded = scene.mesh;
    auto start = std::clock();
    comparison.plain.failed = !has_areas(scene.mesh);
    if (!comparison.plain.failed) {
      PMP::isotropic_remeshing(plain.faces(), length, plain, np);
      comparison.plain.seconds = seconds_since(start);
      measure(plain, length, &scene.mesh, comparison.plain);
    }

    start = std::clock();
    Sculptor<Mesh> sculptor(guarded);
    comparison.set_up = seconds_since(start);
    const test::Mesh_snapshot before = test::snapshot(sculptor);
    start = std::clock();
    const Remeshing_report report = haptic_sculpt::isotropic_remeshing(sculptor, length, np);
    comparison.guarded.seconds = seconds_since(start);
    for (const auto& count : {report.splits, report.collapses, report.flips, report.moves}) {
      comparison.asked += count.done + count.refused;
      comparison.refused += count.refused;
    }
    measure(guarded, length, &scene.mesh, comparison.guarded);
    undo_and_redo(sculptor, before, comparison);
    tell(comparison);
  }
}

Json move_all_by_a_tenth(Mesh mesh, unsigned seed) {
  const auto targets = mesh.add_property_map<Vertex_index, Point_3>("v:target").first;
  std::mt19937 random(seed);
  const auto uniform = [&] { return random() / 2147483648.0 - 1; };
  for (const Vertex_index v : mesh.vertices()) {
    const double edge = std::sqrt(CGAL::squared_distance(mesh.point(v), mesh.point(mesh.source(mesh.halfedge(v)))));
    Vector_3 d;
    do {
      const double x = uniform(), y = uniform(), z = uniform(); // in this order, whatever the compiler
      d = Vector_3(x, y, z);
    } while (d.squared_length() > 1 || d.squared_length() < 0.01);
    targets[v] = mesh.point(v) + 0.1 * edge / std::sqrt(d.squared_length()) * d;
  }
  auto start = std::clock();
  Sculptor<Mesh> sculptor(mesh);
  const double set_up = seconds_since(start);
  start = std::clock();
  const Move_report report = move_vertices(sculptor, mesh.vertices(), targets);
  const double seconds = seconds_since(start);
  start = std::clock();
  const bool intersects = PMP::does_self_intersect(mesh);
  const double check = seconds_since(start);
  return {{"faces", mesh.number_of_faces()},
          {"asked", report.asked},
          {"reached", report.reached},
          {"drags", report.drags},
          {"set_up_seconds", set_up},
          {"seconds", seconds},
          {"does_self_intersect_seconds", check},
          {"self_intersects", intersects}};
}

} // namespace haptic_sculpt::benchmark
