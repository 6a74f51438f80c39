// SPDX-License-Identifier: GPL-3.0-or-later
// How do I: several objects, constrained vertices, a brush, a copy to try on, progress and cancel, a mesh that is
// refused, float files.
#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/sculpting/isotropic_remeshing.h>
#include <haptic_sculpt/sculpting/move_vertices.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/generators.h>

#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace params = CGAL::parameters;

int main(int argc, char** argv) try {
  Mesh mesh, other;
  CGAL::make_icosahedron(mesh, Kernel::Point_3(0, 0, 0), 1.0);
  CGAL::make_icosahedron(other, Kernel::Point_3(3, 0, 0), 1.0);

  // Several objects are several components of one mesh.
  CGAL::copy_face_graph(other, mesh);
  haptic_sculpt::Sculptor<Mesh> sculptor(mesh);

  // Constrained vertices: those that are not given do not move; remeshing leaves marked ones where they are.
  const auto target = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_3>("v:target").first;
  const auto is_constrained = mesh.add_property_map<Mesh::Vertex_index, bool>("v:constrained", false).first;
  std::vector<Mesh::Vertex_index> free_vertices;
  for (const auto v : mesh.vertices()) {
    target[v] = mesh.point(v) + Kernel::Vector_3(2, 0, 0);
    is_constrained[v] = mesh.point(v).x() > 1.5;
    if (!is_constrained[v])
      free_vertices.push_back(v);
  }

  // Progress and cancel: false ends the call, and what was done is one step of undo.
  const auto progress = [](const haptic_sculpt::Move_progress& at) {
    std::cerr << at.behind << " of " << at.asked << " are not there yet\n";
    return true;
  };
  const auto moved = haptic_sculpt::move_vertices(sculptor, free_vertices, target,
                                                  haptic_sculpt::Move_parameters().progress(progress));
  std::cout << moved.reached << " of " << moved.asked << " arrived; the other object was in the way\n";
  haptic_sculpt::isotropic_remeshing(sculptor, 0.7, params::vertex_is_constrained_map(is_constrained));

  // A brush: what is within 0.8 of the top is inflated by 0.05.
  const haptic_sculpt::Dab_3<Kernel> dab{haptic_sculpt::Brush_kind::inflate, {0, 0, 1}, 0.8, 0.05};
  const auto dabbed = haptic_sculpt::apply_brush(sculptor, std::vector<haptic_sculpt::Dab_3<Kernel>>{dab});
  std::cout << dabbed.reached << " of " << dabbed.asked << " vertices are where the brush wants them\n";

  // A copy to try on; or try on the mesh itself, and undo.
  Mesh copy = mesh;
  haptic_sculpt::Sculptor<Mesh> trial(copy, haptic_sculpt::parameters::known_valid(true));
  trial.grab(*copy.vertices().begin()).drag_to({0, 0, 5});
  while (sculptor.undo())
    ;

  // A mesh that is refused: every fault is in the report.
  Mesh open;
  CGAL::make_triangle(Kernel::Point_3(0, 0, 0), Kernel::Point_3(1, 0, 0), Kernel::Point_3(0, 1, 0), open);
  const haptic_sculpt::Validity_report report = haptic_sculpt::validate(open);
  std::cout << "refused: " << report.boundary_edges.size() << " edges have one face only\n";

  // Files of floats: refused where rounding would change the surface, unless it is allowed and the result is valid.
  haptic_sculpt::Write_parameters parameters;
  parameters.encoding(haptic_sculpt::Write_parameters::Encoding::binary).allow_rounding();
  if (argc == 2)
    haptic_sculpt::write_surface(argv[1], mesh, parameters); // .stl
  return report.is_valid() || moved.reached == moved.asked || !haptic_sculpt::validate(mesh).is_valid() ? 1 : 0;
} catch (const haptic_sculpt::Error& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
