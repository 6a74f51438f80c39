// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Run_result.h"

#include <exception>
#include <utility>

namespace haptic_sculpt::sculpt_program {

/// What a `move` does, told as the lines that do it again without a search: its shifts, in a stroke. The journal of
/// Journaled_edits.
class Move_lines {
public:
  /// Both must outlive this.
  Move_lines(const Command& move, const After_command& after) : move_(&move), after_(&after) {}

  /// Tells a shift as soon as it stands, and the stroke before the first. Not its end: a log that has none is of a move
  /// that broke off.
  void add(const Edit& edit) noexcept {
    if (edit.kind != Edit_kind::shift || failure_)
      return;
    try {
      if (!std::exchange(has_moved_, true))
        tell(Edit::of(Edit_kind::stroke));
      tell(edit);
    } catch (...) { // memory's; the mesh goes on as it must
      failure_ = std::current_exception();
    }
  }
  void break_off() const {} ///< what is thrown ends the script
  bool has_moved() const { return has_moved_; }
  /// The move is done. \return whether it has told anything \throw what telling has thrown
  bool end() {
    if (failure_)
      std::rethrow_exception(failure_);
    if (has_moved_)
      tell(Edit::of(Edit_kind::end));
    return has_moved_;
  }

  /// An edit as a line that comes from that of the move.
  Command line_of(Command line) const {
    line.line = move_->line, line.is_logged = move_->is_logged, line.script_line = move_->script_line;
    return line;
  }

private:
  const Command* move_;
  const After_command* after_;
  bool has_moved_ = false;
  std::exception_ptr failure_;

  void tell(const Edit& edit) const { (*after_)(line_of(Command(edit))); }
};

} // namespace haptic_sculpt::sculpt_program
