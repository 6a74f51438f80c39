// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Log_text.h"

#include <atomic>
#include <filesystem>
#include <optional>

#include <sys/types.h>

namespace haptic_sculpt::examples {

/// An edit log on the disk, locked against other processes as long as the object lives. One write a line, when the edit
/// is done, so that a killed process loses at most the edit under way.
class Log_file {
public:
  /// Opens, locks and reads what is there, and changes nothing. An empty file, and what a killed process has left of a
  /// head, count as none.
  /// \throw Foreign_log, Script_error, Write_error (no regular file; another process has it; may not be written)
  Log_file(const std::string& path, const std::string& mesh);
  Log_file(const Log_file&) = delete;
  Log_file& operator=(const Log_file&) = delete;
  ~Log_file();

  /// What the log held when it was opened; none of a new one.
  const std::optional<Log_contents>& contents() const { return contents_; }

  /// From here on it is written: a new log gets its head, an old one loses its unfinished last line.
  /// \throw Write_error if a new one cannot be made, but not if the disk is full; Foreign_log if what is there is no
  /// part of its head
  void begin(const Settings& settings);

  /// Of a log that a killed loop has left, drops what was done in a tick that is not whole. To be called before
  /// `begin()`.
  void drop_unfinished_tick();
  /// Drops what comes from the last line of the last pass's script, which makes it again. To be called before
  /// `begin()`. \pre the contents have one
  void drop_last_line();

  /// Takes it away while it is still locked: another process finds none, or one of its own.
  void remove();

  /// \name Appending
  /// After a failure, at once and for good, nothing is appended: a log ends where the first line is missing. Memory
  /// that does not suffice is such a failure.
  ///@{
  /// What follows comes from the script with this hash, from the lines after this one. Strokes that are open end here.
  void begin_pass(const std::string& script, std::size_t after);
  void append(const Command& command);
  /// What a loop did in a tick, in one write; nothing but the end of the tick where `commands` are none.
  void append_tick(const std::vector<Command>& commands, std::size_t tick);
  /// The script has been carried out to its end, and the results are written.
  void end_pass(const std::string& script);
  /// What was to be appended is not there. \param why as in "cannot append to the log: "
  void fail(const char* why);
  static constexpr const char* no_memory = "the memory does not suffice"; ///< such a reason
  ///@}

  /// Why the log does not hold all that was appended; empty if it does.
  const std::string& failure() const { return failure_; }
  /// Whether there is one: for other threads than that which appends.
  bool has_failed() const { return has_failed_; }

private:
  std::string path_, mesh_;
  std::filesystem::path target_; ///< with links followed
  int file_ = -1;
  off_t size_ = 0; ///< up to the end of what stands: the last whole line, or a part of the head
  std::optional<Log_contents> contents_;
  std::string part_of_head_; ///< all that is there where there are no contents
  Log_writer writer_;
  std::string failure_;
  std::atomic<bool> has_failed_{false};

  void cut_to(const Log_contents::Place& place, const char* what);
  /// \param lines `lines()` makes them
  template <class Lines>
  void append_made(const Lines& lines);
  void write(const std::string& lines);
  void lock() const;
  bool is_at_its_path() const;
};

} // namespace haptic_sculpt::examples
