// SPDX-License-Identifier: GPL-3.0-or-later
// What is near, what a ray meets; a visitor that hears of every edit; drags whose work is bounded.
#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/boost/graph/generators.h>

#include <iostream>

using namespace haptic_sculpt;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

bool find_elements(Sculptor<Mesh>& sculptor) {
  const Kernel::Point_3 eye(0.3, 0, 3), far(0.3, 0, -3);

  const auto v = sculptor.nearest_vertex({0.1, 0.2, 0.3}, 0.05); // the null index where none is within 0.05
  if (auto hit = sculptor.first_hit(eye, far))                   // closed segment from eye to far
    if (hit->feature == Surface_feature::edge)
      sculptor.insert_on_edge(hit->edge, hit->point);

  return !v.is_valid();
}

bool count_faces(Mesh mesh) {
  struct Face_count : haptic_sculpt::Default_edit_visitor {
    std::ptrdiff_t faces = 0;
    void face_dies(Mesh::Face_index) { --faces; }
    void face_created(Mesh::Face_index) { ++faces; }
  };
  haptic_sculpt::Sculptor<Mesh, haptic_sculpt::Box_tree_broad_phase<Mesh>, Face_count> sculptor(mesh);
  const std::size_t before = mesh.number_of_faces();
  const auto e = *mesh.edges().begin();
  sculptor.insert_on_edge(e, CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  std::cout << "faces: " << sculptor.visitor().faces << " more\n"; // the Sculptor's own copy of the visitor
  return sculptor.visitor().faces > 0 && before + std::size_t(sculptor.visitor().faces) == mesh.number_of_faces();
}

bool drag_in_portions(Mesh mesh) {
  Sculptor<Mesh> sculptor(mesh);
  const Mesh::Vertex_index v(0);
  const Kernel::Point_3 target = mesh.point(v) + 0.3 * Kernel::Vector_3(mesh.point(v), {0, 0, 0});
  const int most = 1000; // portions
  int portions = 1;

  const auto portion = Drag_parameters().work_limit(150);
  auto grab = sculptor.grab(v);
  Drag_result<Mesh> r = grab.drag_to(target, portion); // r.work pairs, r.end == Drag_end::work_limit: call again

  for (; r.end == Drag_end::work_limit && portions < most; ++portions)
    r = grab.drag_to(target, portion);
  std::cout << "there after " << portions << " portions\n";
  return r.reached;
}

bool undo_a_stroke(Mesh mesh) {
  Sculptor<Mesh> sculptor(mesh);
  const Mesh::Vertex_index v(0);
  const auto e = *mesh.edges().begin();
  const Kernel::Point_3 home = mesh.point(v);
  const std::vector<Kernel::Point_3> path = {home + Kernel::Vector_3(0.01, 0, 0), home + Kernel::Vector_3(0, 0.01, 0)};

  {
    const auto stroke = sculptor.stroke();
    for (const auto& target : path)
      sculptor.grab(v).drag_to(target);
    sculptor.flip(e);
  }
  sculptor.undo(); // all of it

  return mesh.point(v) == home && sculptor.history().number_of_undo_steps() == 0 &&
         sculptor.history().number_of_redo_steps() == 1;
}

int main() {
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Kernel::Point_3(0, 0, 0), 1.0);
  Mesh searched = mesh;
  Sculptor<Mesh> sculptor(searched);
  const bool is_good = find_elements(sculptor) && count_faces(mesh) && drag_in_portions(mesh) && undo_a_stroke(mesh);
  return is_good && validate(searched).is_valid() ? 0 : 1;
}
