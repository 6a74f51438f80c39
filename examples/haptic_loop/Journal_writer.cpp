// SPDX-License-Identifier: GPL-3.0-or-later
#include "Journal_writer.h"

#include <chrono>

namespace haptic_sculpt::loop_program {
namespace {

using sculpt_program::Command;

/// As a line of a script.
Command command_of(const Journal_entry& entry) {
  const auto of_kind = [&](Command::Kind kind, std::size_t vertices, bool has_point) {
    Command command;
    command.kind = kind;
    command.indices.assign(entry.vertices.begin(), entry.vertices.begin() + static_cast<std::ptrdiff_t>(vertices));
    if (has_point)
      command.points = {entry.point};
    return command;
  };
  switch (entry.kind) {
  case Journal_entry::Kind::move:
    return of_kind(Command::Kind::drag, 1, true);
  case Journal_entry::Kind::insert_on_face:
    return of_kind(Command::Kind::insert_face, 3, true);
  case Journal_entry::Kind::insert_on_edge:
    return of_kind(Command::Kind::insert_edge, 2, true);
  case Journal_entry::Kind::remove:
    return of_kind(Command::Kind::remove, 1, false);
  case Journal_entry::Kind::collapse:
    return of_kind(Command::Kind::collapse, 2, false);
  case Journal_entry::Kind::flip:
    return of_kind(Command::Kind::flip, 2, false);
  case Journal_entry::Kind::undo:
    return of_kind(Command::Kind::undo, 0, false);
  case Journal_entry::Kind::redo:
    return of_kind(Command::Kind::redo, 0, false);
  case Journal_entry::Kind::stroke:
    return of_kind(Command::Kind::stroke, 0, false);
  default:
    return of_kind(Command::Kind::end, 0, false);
  }
}

} // namespace

Journal_writer::Journal_writer(sculpt_program::Log_file& log, Edit_journal& journal)
    : log_(&log), journal_(&journal), thread_([this] { run(); }) {}

void Journal_writer::finish() {
  is_ending_ = true;
  if (thread_.joinable())
    thread_.join();
}

void Journal_writer::run() {
  for (;;) {
    const bool was_ending = is_ending_; // asked before the queue: what was added before the end is seen then
    if (!is_stalled_ && write_what_is_there())
      continue;
    if (was_ending)
      return;
    std::this_thread::sleep_for(std::chrono::duration<double>(pause));
  }
}

/// A tick or less. \return whether there was anything
bool Journal_writer::write_what_is_there() {
  Journal_entry entry;
  if (!journal_->take(entry))
    return false;
  if (entry.kind != Journal_entry::Kind::tick) {
    commands_.push_back(command_of(entry));
    return true;
  }
  log_->append_tick(commands_, static_cast<std::size_t>(entry.vertices[0]) + 1); // from 1, as lines are
  commands_.clear();
  ++ticks_;
  journal_->wrote(1);
  return true;
}

} // namespace haptic_sculpt::loop_program
