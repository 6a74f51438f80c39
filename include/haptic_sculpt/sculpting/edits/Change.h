// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/exact_integers.h>
#include <haptic_sculpt/sculpting/Edit.h>

namespace haptic_sculpt::internal {

/// An edit that was made, and beside it what it takes to take it back. In numbers of vertices that last.
struct Change {
  Edit edit;            ///< of kind move, insert_on_face, insert_on_edge, collapse, flip or shift
  Coordinates before{}; ///< move, collapse: where the first vertex was
  /// insert: the vertex created; collapse: the link of the first vertex, beginning with the second; flip: the ends of
  /// the new edge.
  std::vector<std::size_t> around;
  std::vector<double> starts; ///< shift: of each vertex of `edit.ways`, its coordinate along the axis before
};

} // namespace haptic_sculpt::internal
