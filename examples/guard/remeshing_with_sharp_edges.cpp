// SPDX-License-Identifier: GPL-3.0-or-later
// A cube with a coarse and a fine remeshing: its edges are found by their angle and stay.
#include "example_meshes.h"

#include <haptic_sculpt/sculpting/isotropic_remeshing.h>

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/boost/graph/generators.h>

#include <iostream>

int main() {
  Mesh mesh;
  using P = Kernel::Point_3;
  CGAL::make_hexahedron(P(0, 0, 0), P(1, 0, 0), P(1, 1, 0), P(0, 1, 0), P(0, 1, 1), P(0, 0, 1), P(1, 0, 1), P(1, 1, 1),
                        mesh);
  CGAL::Polygon_mesh_processing::triangulate_faces(mesh);
  const auto is_sharp = mesh.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
  std::cout << "self-intersecting pairs before: " << self_intersecting_pairs(mesh) << '\n';

  haptic_sculpt::Sculptor<Mesh> sculptor(mesh);
  bool is_good = true;
  for (const double length : {0.05, 0.2}) {
    const auto report = haptic_sculpt::isotropic_remeshing(
        sculptor, length, CGAL::parameters::number_of_iterations(5).edge_is_constrained_map(is_sharp),
        haptic_sculpt::Remeshing_parameters().feature_angle(45));
    double sharp = 0;
    for (const auto e : mesh.edges())
      if (is_sharp[e])
        sharp += CGAL::Polygon_mesh_processing::edge_length(e, mesh);
    std::cout << "after, with edges of " << length << ": " << self_intersecting_pairs(mesh) << "; "
              << mesh.number_of_faces() << " faces, volume " << CGAL::Polygon_mesh_processing::volume(mesh)
              << ", sharp edges of length " << sharp << "; " << report.splits.done << " splits, "
              << report.collapses.done << " collapses, " << report.flips.done << " flips\n";
    is_good = is_good && self_intersecting_pairs(mesh) == 0 && std::abs(sharp - 12) < 1e-9;
  }
  return is_good ? 0 : 1;
}
