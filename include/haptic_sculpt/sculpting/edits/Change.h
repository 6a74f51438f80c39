// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/exact_integers.h>
#include <haptic_sculpt/sculpting/Edit.h>

namespace haptic_sculpt::internal {

/// An edit that was made, and what it takes to take it back. In numbers of vertices that last.
struct Change {
  Edit_kind kind = Edit_kind::move; ///< move, insert_on_face, insert_on_edge, collapse, flip or shift
  std::size_t vertex =
      0; ///< the vertex moved, created or removed; of a flip, the first of `around`; of a shift, the axis
  Coordinates before{};   ///< where it was: move, collapse
  Coordinates after{};    ///< where it is: move, insert
  /// insert_on_face: the corners; insert_on_edge: the ends; collapse: the link, beginning with the neighbour it went
  /// into; flip: the ends of the old edge, then those of the new one; shift: those that move. Of a move none.
  std::vector<std::size_t> around;
  std::vector<std::array<double, 2>>
      ways; ///< shift: of each vertex around, its coordinate along the axis before and after
};

} // namespace haptic_sculpt::internal
