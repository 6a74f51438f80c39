// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Log_file.h"

#include <haptic_sculpt/haptic_rendering/exchange/Edit_journal.h>

#include <chrono>
#include <thread>

namespace haptic_sculpt::examples {

/// Writes a journal into a log, in a thread of its own: one write a tick, so that a log always ends at the end of a
/// tick or in the middle of one write.
class Journal_writer {
public:
  /// How long it sleeps where nothing is there, s. What is lost by a kill is at least as old as that.
  static constexpr double pause = 0.001;

  /// Both must outlive this. \pre the log has been begun
  Journal_writer(Log_file& log, Edit_journal& journal);
  ~Journal_writer() { finish(); }

  /// Writes what is left, and ends. After it the log is the caller's again.
  void finish();
  /// From here on nothing is written, as if the disk did not answer: to try out what happens then.
  void stall() { is_stalled_ = true; }
  bool is_stalled() const { return is_stalled_; }
  /// Ticks written. \pre finish() has been called
  std::uint64_t ticks() const { return ticks_; }
  /// Edits taken that the log could not take. \pre finish() has been called
  std::uint64_t unwritten() const { return unwritten_; }

private:
  Log_file* log_;
  Edit_journal* journal_;
  std::atomic<bool> is_ending_{false}, is_stalled_{false};
  std::uint64_t ticks_ = 0, unwritten_ = 0;
  std::vector<Command> commands_;
  std::thread thread_; ///< last: it uses the others

  void run();
  bool write_what_is_there();
  bool drop_what_is_there();
};

} // namespace haptic_sculpt::examples
