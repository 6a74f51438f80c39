// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_FACES_AROUND_H
#define HAPTIC_SCULPT_SCULPTING_FACES_AROUND_H

#include <haptic_sculpt/sculpting/edits/Vertex_ids.h>
#include <haptic_sculpt/surface/Face_corners.h>
#include <haptic_sculpt/surface/Round_marks.h>

#include <algorithm>

namespace haptic_sculpt {
namespace internal {

/// Collects the faces around vertices given by their numbers, each face once, in any order.
/// \pre all of the vertices are in the mesh
/// Cost: linear in the faces collected. Where they are around half of all vertices or more, all faces are looked at in
/// their order, which takes a fraction of the time: nothing waits for halfedges.
template <class Mesh>
void collect_faces_around(const Mesh& mesh, const Face_corners<Mesh>& corners_of, const Vertex_ids<Mesh>& ids,
                          const std::vector<std::size_t>& numbers, Round_marks& is_taken,
                          std::vector<typename Mesh::Face_index>& faces) {
  faces.clear();
  is_taken.begin(std::max<std::size_t>(mesh.num_faces(), mesh.num_vertices()));
  if (2 * numbers.size() >= mesh.number_of_vertices()) {
    for (const std::size_t number : numbers)
      is_taken.mark(static_cast<std::size_t>(ids.vertex(number)));
    const auto is_marked = [&is_taken](auto v) { return is_taken.is_marked(static_cast<std::size_t>(v)); };
    for (const auto f : mesh.faces())
      if (const auto& v = corners_of(f); is_marked(v[0]) || is_marked(v[1]) || is_marked(v[2]))
        faces.push_back(f);
    return;
  }
  for (const std::size_t number : numbers)
    for (const auto f : mesh.faces_around_target(mesh.halfedge(ids.vertex(number))))
      if (is_taken.mark(static_cast<std::size_t>(f)))
        faces.push_back(f);
}

} // namespace internal
} // namespace haptic_sculpt

#endif
