// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/edits/Edit_records.h>

#include <memory>
#include <optional>
#include <utility>

namespace haptic_sculpt::internal {

/// New changes on their way to the records, at once or by trial.
///
/// From begin_trial() to end_trial() shifts, or else moves, are no records yet: those that are undone meanwhile
/// never are, and clear nothing that could be redone. Another edit makes records of those that stand.
class Edit_history : public Edit_records {
public:
  /// Room for the record of a change: to be called before it is made, so that push() allocates nothing.
  /// \param ids how many numbers of vertices there are \throw std::bad_alloc, and no record has changed
  void make_room_for_move(std::size_t ids) {
    reserve_records(1 + is_trial_, 0, 0, 1 + is_trial_); // the one tried before it may become a record
    if (is_in_stroke())
      reserve_ids(ids);
  }
  void make_room_for(const Change& change) {
    std::size_t words = words_of(change);
    for (const auto& tried : tried_shifts_)
      words += words_of(*tried);
    tried_shifts_.reserve(tried_shifts_.size() + is_trial_);
    const std::size_t edits = 1 + tried_shifts_.size();
    reserve_records(0, edits, words, edits + 1); // a move that was tried is one
  }

  /// A new change. Clears what could be redone. Allocates nothing. \pre room has been made for it
  void push_move(std::size_t vertex, const Coordinates& before, const Coordinates& after) {
    if (is_trial_) {
      if (tried_move_ && tried_move_->vertex != vertex)
        note_tried();
      if (!tried_move_)
        tried_move_ = Move{vertex, before, before};
      tried_move_->after = after;
      if (tried_move_->before == after)
        tried_move_.reset();
      return;
    }
    record_move(vertex, before, after);
  }
  /// \pre it is no move
  void push(const Change& change) {
    note_tried();
    record(change);
  }

  void begin_trial() { is_trial_ = true; }
  /// Allocates nothing.
  void end_trial() noexcept {
    note_tried();
    is_trial_ = false;
  }
  /// As push(). \param shift is kept where it is until the trial ends: whoever makes it may still read it
  void push_shift(std::unique_ptr<Change>& shift) {
    if (!is_trial_)
      return push(*shift);
    tried_shifts_.push_back(std::move(shift));
  }
  /// How many shifts of the trial under way stand, and the last of them.
  std::size_t tried_shifts() const { return tried_shifts_.size(); }
  const Change& tried_shift() const { return *tried_shifts_.back(); }
  /// It has been taken back. \return it
  std::unique_ptr<Change> drop_tried_shift() {
    auto dropped = std::move(tried_shifts_.back());
    tried_shifts_.pop_back();
    return dropped;
  }

private:
  bool is_trial_ = false;
  std::optional<Move> tried_move_;
  std::vector<std::unique_ptr<Change>> tried_shifts_; ///< in their order

  /// What was tried and stands.
  void note_tried() {
    if (const auto move = std::exchange(tried_move_, std::nullopt))
      record_move(move->vertex, move->before, move->after);
    for (const auto& shift : tried_shifts_)
      record(*shift);
    tried_shifts_.clear();
  }
};

} // namespace haptic_sculpt::internal
