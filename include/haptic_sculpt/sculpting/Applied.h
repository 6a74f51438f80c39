// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Drag_result.h>
#include <haptic_sculpt/sculpting/Edit.h>
#include <haptic_sculpt/sculpting/Edit_result.h>

namespace haptic_sculpt {

/// What came of an edit that was given by value.
template <class Mesh>
struct Applied : Edit_result<Mesh> {
  /// As it can be done again: a slide as its legs, a removal as the collapse that it was. Of kind `none` where it was
  /// refused, or nothing has moved; but an undo or redo that was refused and has ended a stroke is itself:
  /// it is refused again where the history is as long, by the same limits and what was forgotten.
  Edit edit;
  std::optional<Drag_result<Mesh>> drag; ///< of a move: the last leg's

  operator Edit() const { return edit; } ///< to be kept, or given to apply() again
};

} // namespace haptic_sculpt
