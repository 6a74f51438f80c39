// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/surface/Box_3.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

namespace haptic_sculpt {

/// The smallest box around a triangle. \pre f is a triangle.
template <class Mesh>
Box_3 face_box(const Mesh& mesh, typename Mesh::Face_index f) {
  const auto h = mesh.halfedge(f);
  Box_3 box(vertex_coordinates(mesh, mesh.target(h)));
  box.include(vertex_coordinates(mesh, mesh.target(mesh.next(h))));
  box.include(vertex_coordinates(mesh, mesh.source(h)));
  return box;
}

/// The same where the corners are known. Cost: three points read.
template <class Mesh>
Box_3 face_box(const Mesh& mesh, const std::array<typename Mesh::Vertex_index, 3>& corners) {
  Box_3 box(vertex_coordinates(mesh, corners[0]));
  box.include(vertex_coordinates(mesh, corners[1]));
  box.include(vertex_coordinates(mesh, corners[2]));
  return box;
}

namespace internal {

/// The smallest box around all vertices of a mesh. Cost: linear.
template <class Mesh>
Box_3 mesh_box(const Mesh& mesh) {
  const Rounding_to_nearest rounding; // a caller's mode may take what is subnormal for 0
  Box_3 box;
  for (const auto v : mesh.vertices())
    box.include(vertex_coordinates(mesh, v));
  return box;
}

} // namespace internal
} // namespace haptic_sculpt
