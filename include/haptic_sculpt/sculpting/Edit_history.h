// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_EDIT_HISTORY_H
#define HAPTIC_SCULPT_SCULPTING_EDIT_HISTORY_H

#include <haptic_sculpt/collision/exact_integers.h>

#include <cstdint>
#include <deque>
#include <vector>

namespace haptic_sculpt {

/// What kind of change a step of the history is.
enum class Edit_kind : std::uint8_t { move, insert_on_face, insert_on_edge, remove };

/// One change of the mesh, in numbers of vertices that last: enough to make it and to take it back.
struct Edit {
  Edit_kind kind;
  std::size_t vertex;            ///< the vertex moved, created or removed
  internal::Coordinates before;  ///< where it was: move, remove
  internal::Coordinates after;   ///< where it is: move, insert
  /// insert_on_face: the corners; insert_on_edge: the ends; remove: the link, beginning with the neighbour it went into.
  std::vector<std::size_t> around;
};

/// The changes made, and those taken back. Memory: constant per move and creation, the valence per removal.
class Edit_history {
public:
  /// A new change. Clears what could be redone.
  void push(Edit edit) {
    steps_.erase(steps_.begin() + static_cast<std::ptrdiff_t>(done_), steps_.end());
    steps_.push_back(std::move(edit));
    ++done_;
  }

  const Edit* to_undo() const { return done_ > 0 ? &steps_[done_ - 1] : nullptr; }
  const Edit* to_redo() const { return done_ < steps_.size() ? &steps_[done_] : nullptr; }
  void undone() { --done_; }
  void redone() { ++done_; }

  std::size_t number_of_undo_steps() const { return done_; }
  std::size_t number_of_redo_steps() const { return steps_.size() - done_; }

private:
  std::deque<Edit> steps_;
  std::size_t done_ = 0;
};

} // namespace haptic_sculpt

#endif
