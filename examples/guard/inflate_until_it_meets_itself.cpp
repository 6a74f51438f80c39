// SPDX-License-Identifier: GPL-3.0-or-later
// A ring is inflated by more than its hole is wide: every vertex along its normal, as far as there is room.
#include "example_meshes.h"

#include <haptic_sculpt/sculpting/move_vertices.h>

#include <CGAL/Polygon_mesh_processing/compute_normal.h>

#include <iostream>

int main() {
  Mesh mesh = torus(48, 16, 0.4);
  auto targets = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_3>("v:target").first;
  auto normals = mesh.add_property_map<Mesh::Vertex_index, Kernel::Vector_3>("v:normal").first;
  CGAL::Polygon_mesh_processing::compute_vertex_normals(mesh, normals);
  for (const auto v : mesh.vertices())
    targets[v] = mesh.point(v) + 0.75 * normals[v];

  Mesh plain = mesh;
  for (const auto v : plain.vertices())
    plain.point(v) = targets[v];
  std::cout << "self-intersecting pairs before: " << self_intersecting_pairs(mesh) << '\n'
            << "with all vertices at their targets: " << self_intersecting_pairs(plain) << '\n';

  haptic_sculpt::Sculptor<Mesh> sculptor(mesh);
  const auto progress = [](const haptic_sculpt::Move_progress& p) { return p.drags < 100000; };
  std::vector<Mesh::Vertex_index> behind;
  const haptic_sculpt::Move_report report =
      haptic_sculpt::move_vertices(sculptor, mesh.vertices(), targets,
                                   haptic_sculpt::Move_parameters().progress(progress), std::back_inserter(behind));
  std::cout << "moved: " << self_intersecting_pairs(mesh) << "; " << report.reached << " of " << report.asked
            << " vertices arrived, " << 100 * (1 - report.left_l2 / report.asked_l2) << " % of the way was made in "
            << report.drags << " drags\n";
  return self_intersecting_pairs(plain) > 0 && self_intersecting_pairs(mesh) == 0 && !behind.empty() ? 0 : 1;
}
