// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_WINDOW_LOG_THREAD_H
#define HAPTIC_SCULPT_EXAMPLES_WINDOW_LOG_THREAD_H

#include "../sculpt/Log_file.h"

#include <boost/lockfree/spsc_queue.hpp>

#include <atomic>
#include <thread>

namespace haptic_sculpt::window_program {

/// A line of the log on its way to the disk.
struct Logged_edit {
  sculpt_program::Command::Kind kind;
  std::uint8_t indices = 0;
  bool has_point = false;
  std::array<std::size_t, 3> index{};
  std::array<double, 3> point{};
  const char* word = "";
};

/// Writes an edit log of the format of `sculpt` in a thread of its own, so that the loop never waits for a disk: what
/// was done is on the disk some milliseconds later, each line by one write, and a killed process loses no more.
///
/// A move is logged as the straight legs that were proven free, so `sculpt` makes it again to the last bit, whatever
/// the bound on the work of a drag was.
class Log_thread {
public:
  /// \throw what Log_file throws
  Log_thread(const std::string& path, const std::string& mesh_hash) : path_(path), file_(path, mesh_hash) {}
  ~Log_thread() { close(); }

  const std::string& path() const { return path_; }
  /// What it held when it was opened.
  const std::optional<sculpt_program::Log_contents>& contents() const { return file_.contents(); }

  /// From here on edits are written. \throw Write_error
  void begin();
  /// Writes what is left, and ends. Not by the loop's thread.
  void close();

  /// \name The loop's thread
  ///@{
  /// So many more edits find room. An edit that would find none must not be made.
  bool has_room(std::size_t edits) const { return queue_.write_available() >= edits; }
  /// \pre there is room
  void add(const Logged_edit& edit) { queue_.push(edit); }
  ///@}

  /// Whether a line could not be written: the log ends before it.
  bool has_failed() const { return has_failed_; }
  /// Lines written.
  std::uint64_t lines() const { return lines_; }

private:
  std::string path_;
  sculpt_program::Log_file file_;
  boost::lockfree::spsc_queue<Logged_edit> queue_{std::size_t(1) << 16};
  std::atomic<bool> ends_{false}, has_failed_{false};
  std::atomic<std::uint64_t> lines_{0};
  std::thread thread_;

  void write();
};

} // namespace haptic_sculpt::window_program

#endif
