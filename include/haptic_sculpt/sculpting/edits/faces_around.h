// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_FACES_AROUND_H
#define HAPTIC_SCULPT_SCULPTING_FACES_AROUND_H

#include <haptic_sculpt/sculpting/edits/Vertex_names.h>
#include <haptic_sculpt/surface/Face_corners.h>

#include <algorithm>

namespace haptic_sculpt {
namespace internal {

/// Collects the faces around vertices given by their numbers, each face once, in the order of their indices.
/// \pre all of the vertices are in the mesh
/// Cost: n log n of the faces collected, at most linear in all.
template <class Mesh>
void collect_faces_around(const Mesh& mesh, const Vertex_names<Mesh>& names, const std::vector<std::size_t>& numbers,
                          std::vector<typename Mesh::Face_index>& faces) {
  faces.clear();
  constexpr std::size_t many = 8; // an eighth of all: then looking at all faces costs less than sorting some
  if (many * numbers.size() >= mesh.number_of_vertices()) {
    std::vector<bool> is_given(mesh.num_vertices(), false);
    for (const std::size_t number : numbers)
      is_given[static_cast<std::size_t>(names.vertex(number))] = true;
    for (const auto f : mesh.faces()) {
      const auto v = corners_of_face(mesh, f);
      if (is_given[v[0]] || is_given[v[1]] || is_given[v[2]])
        faces.push_back(f);
    }
    return;
  }
  for (const std::size_t number : numbers)
    for (const auto f : mesh.faces_around_target(mesh.halfedge(names.vertex(number))))
      faces.push_back(f);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
}

} // namespace internal
} // namespace haptic_sculpt

#endif
