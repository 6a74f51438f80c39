// SPDX-License-Identifier: GPL-3.0-or-later
// Loop's subdivision of two rings, or of the MESH that is given: alone, and with its points as targets. Each triangle
// is first cut into four that lie in it; then the vertices move to where the subdivision has them.
#include "example_meshes.h"

#include <haptic_sculpt/sculpting/move_vertices.h>
#include <haptic_sculpt/surface/read_surface.h>

#include <CGAL/subdivision_method_3.h>

#include <iostream>

namespace {

/// Leaves vertices where they are, and puts new ones in the middles of edges.
struct Cut_into_four {
  Mesh* mesh;
  void edge_node(Mesh::Halfedge_index h, Kernel::Point_3& p) const {
    p = CGAL::midpoint(mesh->point(mesh->source(h)), mesh->point(mesh->target(h)));
  }
  void vertex_node(Mesh::Vertex_index v, Kernel::Point_3& p) const { p = mesh->point(v); }
  void border_node(Mesh::Halfedge_index h, Kernel::Point_3& edge, Kernel::Point_3& vertex) const {
    edge_node(h, edge);
    vertex_node(mesh->target(h), vertex);
  }
};

} // namespace

int main(int argc, char** argv) try {
  namespace Subdivision = CGAL::Subdivision_method_3;
  Mesh mesh = argc > 1 ? haptic_sculpt::read_surface<Mesh>(argv[1]) : nested_rings(10, 6, 0.25);
  Mesh smooth = mesh; // both are cut in the same order: their vertices have the same descriptors
  Subdivision::PTQ(mesh, Cut_into_four{&mesh}, CGAL::parameters::number_of_iterations(1));
  Subdivision::Loop_subdivision(smooth, CGAL::parameters::number_of_iterations(1));
  const std::size_t alone = self_intersecting_pairs(smooth);
  std::cout << "self-intersecting pairs before: " << self_intersecting_pairs(mesh) << '\n'
            << "after subdivision alone: " << alone << '\n';

  haptic_sculpt::Sculptor<Mesh> sculptor(mesh); // refuses the mesh where rounded middles make faces meet
  const auto report = haptic_sculpt::move_vertices(sculptor, mesh.vertices(), get(CGAL::vertex_point, smooth));
  const std::size_t guarded = self_intersecting_pairs(mesh);
  std::cout << "with its points as targets: " << guarded << "; " << report.reached << " of " << report.asked
            << " vertices arrived, " << 100 * (1 - report.left_l2 / report.asked_l2) << " % of the way was made\n";
  return guarded == 0 && (argc > 1 || alone > 0) ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
