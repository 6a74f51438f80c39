// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_EDIT_H
#define HAPTIC_SCULPT_SCULPTING_EDIT_H

#include <haptic_sculpt/collision/arithmetic/exact_integers.h>

#include <cstdint>
#include <vector>

namespace haptic_sculpt {
namespace internal {

/// What kind of change an edit is. `remove` is a collapse, whoever has chosen where to.
/// `shift` moves many vertices at once along one axis; states between are not embedded.
enum class Edit_kind : std::uint8_t { move, insert_on_face, insert_on_edge, remove, flip, shift };

/// One change of the mesh, in numbers of vertices that last: enough to make it and to take it back.
struct Edit {
  Edit_kind kind = Edit_kind::move;
  std::size_t vertex = 0;         ///< the vertex moved, created or removed; of a flip, the first of `around`; of a shift, the axis
  Coordinates before{}; ///< where it was: move, remove
  Coordinates after{};  ///< where it is: move, insert
  /// insert_on_face: the corners; insert_on_edge: the ends; remove: the link, beginning with the neighbour it went
  /// into; flip: the ends of the old edge, then those of the new one; shift: those that move. Of a move none.
  std::vector<std::size_t> around;
  std::vector<std::array<double, 2>> ways; ///< shift: of each vertex around, its coordinate along the axis before and after
};

} // namespace internal
} // namespace haptic_sculpt

#endif
