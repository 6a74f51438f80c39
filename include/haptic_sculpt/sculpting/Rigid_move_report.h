// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace haptic_sculpt {

/// What blocks vertices that move at once.
enum class Blocking_kind : std::uint8_t {
  vertex_face,     ///< the first vertex would meet the face of the other three
  edge_edge,       ///< the edge of the first two would meet that of the last two
  degenerate_face, ///< the face of the first three would become degenerate; the last is null
  delta            ///< the face of the first three would get an altitude below delta; the last is null
};

/// A place that blocks, by its vertices.
template <class Mesh>
struct Blocking_pair {
  Blocking_kind kind;                                   ///< what would happen there
  std::array<typename Mesh::Vertex_index, 4> vertices; ///< the two features, one after the other
};

/// What became of vertices that were to move as one.
template <class Mesh>
struct Rigid_move_report {
  std::size_t asked = 0; ///< vertices, each once
  /// The share of the way, or of the arc, that all have gone: a multiple of 1/1024. 1: all are at their places, to the
  /// bit.
  double share = 0;
  /// What blocks the next 1024th of the way; none where all of it was gone, a limit has ended it, or the way leads out
  /// of the range of coordinates there. In the order of their vertices: the same with every broad phase.
  std::vector<Blocking_pair<Mesh>> contacts;
  std::size_t drags = 0;    ///< motions asked for, of an axis move one for each vertex
  std::size_t pairs = 0;    ///< decided, where Move_parameters::most_pairs() bounds them, and no more than that; else 0
  bool cancelled = false;   ///< the progress function asked to stop
  bool out_of_work = false; ///< `most_drags` or `most_pairs` has ended it before it was known what blocks

  explicit operator bool() const { return share == 1; } ///< all of the way was gone
};

} // namespace haptic_sculpt
