// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/edits/Vertex_ids.h>
#include <haptic_sculpt/surface/Face_corners.h>
#include <haptic_sculpt/surface/Round_marks.h>

namespace haptic_sculpt::internal {

/// Collects the faces around vertices given by their numbers, each face once.
/// \pre all of the vertices are in the mesh
/// Cost: linear in the faces collected.
template <class Mesh>
void collect_faces_around(const Mesh& mesh, const Vertex_ids<Mesh>& ids, const std::vector<std::size_t>& numbers,
                          Round_marks& is_taken, std::vector<typename Mesh::Face_index>& faces) {
  faces.clear();
  is_taken.begin(mesh.num_faces());
  for (const std::size_t number : numbers)
    for (const auto f : mesh.faces_around_target(mesh.halfedge(ids.vertex(number))))
      if (is_taken.mark(static_cast<std::size_t>(f)))
        faces.push_back(f);
}

} // namespace haptic_sculpt::internal
