// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace haptic_sculpt {

/// What of a surface a segment meets.
enum class Surface_feature : std::uint8_t { vertex, edge, face };

/// The name used in reports: "vertex", "edge" or "face".
inline const char* name_of(Surface_feature feature) {
  constexpr const char* names[] = {"vertex", "edge", "face"};
  return names[static_cast<int>(feature)];
}

/// Where a segment meets the surface first: the answer of `Sculptor::first_hit()`.
template <class Mesh>
struct Surface_hit {
  /// That of the lowest dimension: a vertex, or the inside of an edge or face. Exact; on an embedded surface there is
  /// one.
  Surface_feature feature = Surface_feature::face;
  typename Mesh::Vertex_index vertex; ///< the null index unless it is a vertex
  typename Mesh::Edge_index edge;     ///< the null index unless it is an edge
  typename Mesh::Face_index face;     ///< the face met; of those at the vertex or edge that of the smallest index
  double time = 0;                    ///< as a fraction of the way from the source; rounded, off by less than 2^-39
  typename Mesh::Point point;         ///< where; rounded
};

} // namespace haptic_sculpt
