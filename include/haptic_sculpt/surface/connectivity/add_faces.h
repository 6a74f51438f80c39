// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/boost/graph/Euler_operations.h>

#include <array>
#include <vector>

namespace haptic_sculpt::internal {

/// Adds triangles to a mesh that has their vertices and no face: in their order, and each begins with its own first
/// corner. Time in proportion to the faces, at a hub, too, where Surface_mesh::add_face() looks at all faces there for
/// each. \pre together they are closed, 2-manifold and oriented
template <class Mesh>
void add_faces(const std::vector<std::array<typename Mesh::Vertex_index, 3>>& faces, Mesh& mesh) {
  CGAL::Euler::add_faces(faces, mesh);
  for (const auto f : mesh.faces()) {
    auto h = mesh.halfedge(f);
    while (mesh.source(h) != faces[f][0])
      h = mesh.next(h);
    mesh.set_halfedge(f, h);
  }
}

} // namespace haptic_sculpt::internal
