// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/edits/Edit_records.h>

namespace haptic_sculpt {

/// What undo and redo can make, as it is at each call. Refers to a Sculptor, which has to outlive it.
class History_view {
public:
  std::size_t number_of_undo_steps() const { return history_->number_of_undo_steps(); } ///< a stroke under way counts
  std::size_t number_of_redo_steps() const { return history_->number_of_redo_steps(); } ///< of those taken back
  std::size_t bytes() const { return history_->bytes(); } ///< of all that is kept for both
  bool is_in_stroke() const { return history_->is_in_stroke(); }                        ///< one is under way

private:
  template <class, class, class, class>
  friend class Sculptor;

  explicit History_view(const internal::Edit_records& history) : history_(&history) {}
  const internal::Edit_records* history_;
};

} // namespace haptic_sculpt
