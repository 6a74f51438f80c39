// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace haptic_sculpt {

/// The coordinates of a vertex. \pre the mesh's points have double coordinates.
template <class Mesh>
std::array<double, 3> vertex_coordinates(const Mesh& mesh, typename Mesh::Vertex_index v) {
  const auto& p = mesh.point(v);
  return {p.x(), p.y(), p.z()};
}

} // namespace haptic_sculpt
