// SPDX-License-Identifier: GPL-3.0-or-later
// Edits and undo: creation, collapse, flip; a stroke, which one undo takes back; numbers of vertices that last.
#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/boost/graph/generators.h>

#include <iostream>

int main() {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  using Point_3 = Kernel::Point_3;
  Mesh mesh;
  CGAL::make_tetrahedron(Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(0, 0, 1), mesh);
  haptic_sculpt::Sculptor<Mesh> sculptor(mesh);

  // An edit is proven and done, or refused with a reason, and then nothing has changed.
  const auto refused = sculptor.remove(sculptor.vertex(0));
  std::cout << "removing from a tetrahedron: " << name_of(refused.refusal->reason) << '\n';

  // A vertex on a face. Its number is the next one never used; descriptors are recycled by the mesh, numbers never.
  const auto created = sculptor.insert_on_face(sculptor.face_of(1, 2, 3), Point_3(0.5, 0.5, 0.5));
  if (!created)
    return 1;
  const std::size_t number = sculptor.id(*created.vertex);
  std::cout << "created vertex " << number << ", now " << mesh.number_of_faces() << " faces\n";

  { // All of a stroke is one step of undo.
    const auto stroke = sculptor.stroke();
    auto grab = sculptor.grab(sculptor.vertex(number));
    grab.drag_to({0.75, 0.75, 0.75});
    grab.drag_to({0.75, 0.75, 0.5});
    sculptor.insert_on_edge(sculptor.edge_of(0, 1), Point_3(0.5, 0, 0));
  }
  std::cout << "after the stroke " << mesh.number_of_vertices() << " vertices\n";
  const bool is_back = sculptor.undo() && mesh.point(sculptor.vertex(number)) == Point_3(0.5, 0.5, 0.5);
  std::cout << "undone: " << mesh.number_of_vertices() << " vertices, " << sculptor.history().number_of_redo_steps()
            << " step to redo\n";

  // Collapse draws a vertex into the one named; undo revives it under its old number.
  const auto h = mesh.halfedge(sculptor.vertex(number), sculptor.vertex(1));
  if (!sculptor.collapse(h) || sculptor.vertex(number).is_valid() || !sculptor.undo())
    return 1;
  const auto flipped = sculptor.flip(sculptor.edge_of(1, 2)); // from the tetrahedron's edge into its inside
  std::cout << "flip: " << (flipped ? "done" : name_of(flipped.refusal->reason)) << '\n';
  return is_back && sculptor.vertex(number).is_valid() && haptic_sculpt::validate(mesh).is_valid() ? 0 : 1;
}
