// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sculpting/Random_scene.h"

namespace haptic_sculpt::test {

inline int euler_characteristic(const Mesh& mesh) {
  return static_cast<int>(mesh.number_of_vertices()) - static_cast<int>(mesh.number_of_edges()) +
         static_cast<int>(mesh.number_of_faces());
}

template <class Range>
auto pick(const Range& range, std::size_t size, Random& random) {
  return *std::next(range.begin(), static_cast<std::ptrdiff_t>(random() % size));
}

inline Point_3 in_face(const Mesh& mesh, Mesh::Face_index f, double a, double b) {
  const auto h = mesh.halfedge(f);
  const Point_3 p = mesh.point(mesh.source(h)), q = mesh.point(mesh.target(h)),
                r = mesh.point(mesh.target(mesh.next(h)));
  return p + a * (q - p) + b * (r - p);
}

struct Random_edit {
  enum Kind { drag, insert_on_face, insert_on_edge, remove, collapse, flip, undo, redo } kind;
  bool is_done; ///< a drag: it moved, which a blocked one may have done as well
};

/// Drags, creates, removes, collapses, flips, undoes or redoes, here and there degenerate.
template <class Sculptor_type>
Random_edit random_edit(Sculptor_type& sculptor, Random& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  const Mesh& mesh = sculptor.mesh();
  const Vertex_index v = pick(mesh.vertices(), mesh.number_of_vertices(), random);
  switch (random() % 10) {
  case 0: case 1: {
    const double x = number(random), y = number(random), z = number(random);
    const Point_3 before = mesh.point(v);
    sculptor.grab(v).drag_to(before + (random() % 5 == 0 ? 2 : 0.2) * meshes::Kernel::Vector_3(x, y, z));
    return {Random_edit::drag, mesh.point(v) != before};
  }
  case 2: {
    const auto f = pick(mesh.faces(), mesh.number_of_faces(), random);
    const double a = random() % 4 == 0 ? 1e-9 : 0.4 + 0.2 * number(random), b = random() % 6 == 0 ? 0 : 0.3;
    return {Random_edit::insert_on_face, static_cast<bool>(sculptor.insert_on_face(f, in_face(mesh, f, a, b)))};
  }
  case 3: {
    const auto e = pick(mesh.edges(), mesh.number_of_edges(), random);
    const Point_3 middle = CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)));
    return {Random_edit::insert_on_edge, static_cast<bool>(sculptor.insert_on_edge(e, middle))};
  }
  case 4: return {Random_edit::remove, static_cast<bool>(sculptor.remove(v))};
  case 5: {
    const auto h = pick(mesh.halfedges(), mesh.number_of_halfedges(), random);
    return {Random_edit::collapse, static_cast<bool>(sculptor.collapse(h))};
  }
  case 6: case 7: {
    const auto e = pick(mesh.edges(), mesh.number_of_edges(), random);
    return {Random_edit::flip, static_cast<bool>(sculptor.flip(e))};
  }
  case 8: return {Random_edit::undo, static_cast<bool>(sculptor.undo())};
  default: return {Random_edit::redo, static_cast<bool>(sculptor.redo())};
  }
}

} // namespace haptic_sculpt::test
