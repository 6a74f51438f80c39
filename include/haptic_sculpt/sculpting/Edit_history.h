// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_EDIT_HISTORY_H
#define HAPTIC_SCULPT_SCULPTING_EDIT_HISTORY_H

#include <haptic_sculpt/collision/exact_integers.h>

#include <cstdint>
#include <vector>

namespace haptic_sculpt {

/// What kind of change a step of the history is.
enum class Edit_kind : std::uint8_t { move, insert_on_face, insert_on_edge, remove };

/// One change of the mesh, in numbers of vertices that last: enough to make it and to take it back.
struct Edit {
  Edit_kind kind;
  std::size_t vertex;           ///< the vertex moved, created or removed
  internal::Coordinates before; ///< where it was: move, remove
  internal::Coordinates after;  ///< where it is: move, insert
  /// insert_on_face: the corners; insert_on_edge: the ends; remove: the link, beginning with the neighbour it went
  /// into.
  std::vector<std::size_t> around;
};

/// The changes made, and those taken back. Memory: constant per move and creation, the valence per removal; and the
/// room.
class Edit_history {
public:
  /// So many moves follow a `make_room()` without an allocation: a quarter of a minute of a hand that drags a thousand
  /// times a second. Of moves beyond, one in so many allocates. 1.4 MB.
  static constexpr std::size_t room = std::size_t{1} << 14;

  /// To be called where time does not matter: before a drag begins.
  void make_room() {
    while (blocks_.size() * room < size_ + room)
      add_block();
  }

  /// A new change. Clears what could be redone. A move allocates nothing while there is room.
  void push(Edit edit) {
    for (; size_ > done_; --size_)
      blocks_[(size_ - 1) / room].pop_back();
    if (size_ == blocks_.size() * room)
      add_block();
    blocks_[size_ / room].push_back(std::move(edit));
    ++size_, ++done_;
  }

  const Edit* to_undo() const { return done_ > 0 ? &at(done_ - 1) : nullptr; }
  const Edit* to_redo() const { return done_ < size_ ? &at(done_) : nullptr; }
  void undone() { --done_; }
  void redone() { ++done_; }

  std::size_t number_of_undo_steps() const { return done_; }
  std::size_t number_of_redo_steps() const { return size_ - done_; }

private:
  /// Of up to `room` steps each; all but the last that is in use are full. Steps are never copied when there come more.
  std::vector<std::vector<Edit>> blocks_;
  std::size_t size_ = 0, done_ = 0;

  const Edit& at(std::size_t i) const { return blocks_[i / room][i % room]; }

  void add_block() {
    blocks_.emplace_back();
    blocks_.back().reserve(room);
  }
};

} // namespace haptic_sculpt

#endif
