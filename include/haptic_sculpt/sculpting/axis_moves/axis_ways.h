// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_AXIS_WAYS_H
#define HAPTIC_SCULPT_SCULPTING_AXIS_WAYS_H

#include <haptic_sculpt/sculpting/axis_moves/Axis_move.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

namespace haptic_sculpt {
namespace internal {

/// Has an axis move look at all faces where many move, else at those that move and those whose boxes they sweep over:
/// what they could meet stands still and is found by a broad phase.
template <class Mesh, class Broad_phase>
void take_for(Axis_move<Mesh>& move, const Mesh& mesh, Broad_phase& broad_phase, int axis,
              const Axis_ways<Mesh>& ways) {
  if (move.has_taken_all())
    return;
  constexpr std::size_t many = 8; // an eighth of all vertices: then the search costs more than it spares
  if (many * ways.size() >= mesh.number_of_vertices())
    return move.take(mesh.faces(), true);
  std::vector<std::pair<std::size_t, double>> ends; // by index
  std::vector<typename Mesh::Face_index> faces;
  for (const auto& [v, end] : ways) {
    ends.emplace_back(static_cast<std::size_t>(v), end);
    for (const auto f : mesh.faces_around_target(mesh.halfedge(v)))
      faces.push_back(f);
  }
  std::sort(ends.begin(), ends.end());
  const auto keep_each_once = [&faces] {
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  };
  keep_each_once();
  for (std::size_t i = 0, moving = faces.size(); i < moving; ++i) {
    Box_3 box;
    for (const auto v : corners_of_face(mesh, faces[i])) {
      std::array<double, 3> p = vertex_coordinates(mesh, v);
      box.include(p);
      const auto end =
          std::lower_bound(ends.begin(), ends.end(), std::make_pair(static_cast<std::size_t>(v), -HUGE_VAL));
      if (end != ends.end() && end->first == static_cast<std::size_t>(v)) {
        p[axis] = end->second;
        box.include(p);
      }
    }
    broad_phase.query(box, faces);
  }
  keep_each_once();
  move.take(faces, false);
}

} // namespace internal
} // namespace haptic_sculpt

#endif
