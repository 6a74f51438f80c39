// SPDX-License-Identifier: GPL-3.0-or-later
#include "Log_thread.h"

#include "../sculpt/Sha256.h"

#include <chrono>

namespace haptic_sculpt::window_program {

void Log_thread::begin() {
  sculpt_program::Settings settings;
  settings.response = "stop";
  const bool stops = !contents() || contents()->last_settings().response == settings.response;
  file_.begin(settings);
  // A log says which script its lines come from. That of the window is its hand, and its lines are counted.
  file_.begin_pass(sculpt_program::Sha256().add("the hand in sculpt_window").digest(), 0);
  if (!stops) { // begun by sculpt, under another response
    Logged_edit line{sculpt_program::Command::Kind::response};
    line.word = "stop";
    add(line);
  }
  has_failed_ = !file_.failure().empty();
  thread_ = std::thread([this] { write(); });
}

void Log_thread::close() {
  ends_ = true;
  if (thread_.joinable())
    thread_.join();
}

void Log_thread::write() {
  sculpt_program::Command command;
  for (;;) {
    const bool is_last_look = ends_;
    Logged_edit edit;
    while (queue_.pop(edit)) {
      command.kind = edit.kind;
      command.line = lines_ + 1;
      command.indices.assign(edit.index.begin(), edit.index.begin() + edit.indices);
      command.points.clear();
      if (edit.has_point)
        command.points.push_back(edit.point);
      command.word = edit.word;
      file_.append(command);
      has_failed_ = !file_.failure().empty();
      ++lines_;
    }
    if (is_last_look)
      return;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

} // namespace haptic_sculpt::window_program
