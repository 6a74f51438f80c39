// SPDX-License-Identifier: GPL-3.0-or-later
#include "Journal_writer.h"

#include <chrono>
#include <new>

namespace haptic_sculpt::examples {
Journal_writer::Journal_writer(Log_file& log, Edit_journal& journal)
    : log_(&log), journal_(&journal), thread_([this] { run(); }) {}

void Journal_writer::finish() {
  is_ending_ = true;
  if (thread_.joinable())
    thread_.join();
  unwritten_ += commands_.size(); // of a tick whose end found no room
  commands_.clear();
}

void Journal_writer::run() {
  for (;;) {
    const bool was_ending = is_ending_; // asked before the queue: what was added before the end is seen then
    try {
      if (!is_stalled_ && write_what_is_there())
        continue;
    } catch (const std::bad_alloc&) { // of a tick that is written in no part
      log_->fail(Log_file::no_memory);
    }
    if (was_ending)
      return;
    std::this_thread::sleep_for(std::chrono::duration<double>(pause));
  }
}

/// A tick or less. \return whether there was anything
bool Journal_writer::write_what_is_there() {
  if (log_->has_failed())
    return drop_what_is_there();
  Edit edit;
  if (commands_.size() == commands_.capacity()) // before it is taken: what is taken is not lost for want of room
    commands_.reserve(2 * commands_.size() + 16);
  if (!journal_->take(edit))
    return false;
  if (edit.kind != Edit_kind::none) {
    commands_.emplace_back(std::move(edit)); // straight, as a journal has moves
    return true;
  }
  log_->append_tick(commands_, edit.vertices[0] + 1); // from 1, as lines are
  if (log_->has_failed())
    unwritten_ += commands_.size();
  else
    ++ticks_;
  commands_.clear();
  journal_->wrote(1);
  return true;
}

/// The same of a log that takes nothing any more: what edits must not wait for room in the journal.
bool Journal_writer::drop_what_is_there() {
  unwritten_ += commands_.size();
  std::vector<Command>().swap(commands_); // its memory may be what lacked
  Edit edit;
  if (!journal_->take(edit))
    return false;
  if (edit.kind == Edit_kind::none)
    journal_->wrote(1);
  else
    ++unwritten_;
  return true;
}

} // namespace haptic_sculpt::examples
