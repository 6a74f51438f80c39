// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Recordings: what a hand does, as a script.
#include "Application.h"

#include <haptic_sculpt/version.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace haptic_sculpt::window_program {

void Application::record(const std::string& path) {
  if (button_ >= 0)
    on_release(button_); // a recording has what belongs to a press, or none of it
  if (record_ != nullptr) {
    std::fclose(record_);
    record_ = nullptr, recorded_to_.clear();
    say("the recording has ended");
  }
  if (path.empty() || !may_write(path, Written::recording))
    return;
  const int file =
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NONBLOCK, 0666); // waits for no pipe
  record_ = file < 0 ? nullptr : ::fdopen(file, "w");
  if (record_ == nullptr && file >= 0)
    ::close(file);
  if (record_ == nullptr)
    return fail_to_write("cannot write the recording '" + path + "': " + std::strerror(errno));
  std::fprintf(record_, "# sculpt_window of haptic_sculpt %s, a window of %d x %d\n", HAPTIC_SCULPT_VERSION,
               view_size_[0], view_size_[1]);
  note_choices();
  last_recorded_ = Clock::now();
  recorded_to_ = path, has_moved_ = false;
  say("recording to " + path);
  flush_record();
}

/// What is set when a recording begins, but for the view and masks, and where the mouse is.
void Application::note_choices() {
  const Brush& brush = choices_.brush;
  if (brush.radius > 0)
    std::fprintf(record_, "brush %s %.17g %.17g\n", brush_words[static_cast<int>(brush.use)], brush.radius,
                 brush.strength);
  std::fprintf(record_, "tool %s\nsymmetry", tool_words[static_cast<int>(choices_.tool)]);
  bool has_any = false;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (brush.symmetry[axis])
      std::fprintf(record_, " %c", "xyz"[axis]), has_any = true;
  std::fprintf(record_, "%s\ndepth %.17g\n", has_any ? "" : " none", choices_.depth);
  if (!choices_.slides)
    std::fputs("key t\n", record_);
  if (brush.remeshes)
    std::fputs("key ctrl+d\n", record_);
  std::fprintf(record_, "move %.17g %.17g\n", mouse_.x(), mouse_.y());
}

/// Where the mouse has come to.
void Application::note_move() {
  if (std::exchange(has_moved_, false))
    note("move %.17g %.17g", mouse_.x(), mouse_.y());
}

void Application::note(const char* format, ...) {
  if (record_ == nullptr)
    return;
  note_move();            // before it
  if (record_ == nullptr) // that could not be written
    return;
  const auto now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - std::exchange(last_recorded_, now)).count();
  if (seconds > 0.02) // less is a frame
    std::fprintf(record_, "wait %.3f\n", seconds);
  std::va_list arguments;
  va_start(arguments, format);
  std::vfprintf(record_, format, arguments);
  va_end(arguments);
  std::fputc('\n', record_);
  flush_record();
}

void Application::note_file(const char* what, const std::string& path) {
  const bool can_be_named =
      std::none_of(path.begin(), path.end(), [](unsigned char c) { return c < ' ' || c == '#'; }) && !path.empty() &&
      path.front() != ' ' && path.back() != ' ';
  can_be_named ? note("%s %s", what, path.c_str()) : note("# %s: a file whose name stands in no script", what);
}

void Application::flush_record() {
  if (std::fflush(record_) == 0 && std::ferror(record_) == 0)
    return;
  const int error = errno;
  fail_to_write("cannot write the recording '" + recorded_to_ + "': " + std::strerror(error));
  std::fclose(record_);
  record_ = nullptr, recorded_to_.clear();
}

} // namespace haptic_sculpt::window_program
