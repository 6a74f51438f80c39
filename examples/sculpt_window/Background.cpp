// SPDX-License-Identifier: GPL-3.0-or-later
#include "Background.h"

#include <chrono>

namespace haptic_sculpt::window_program {
namespace {

template <class Future>
bool is_ready(const Future& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

} // namespace

void Background::open(const std::string& path, const std::string& log) {
  opening_ = std::async(std::launch::async, [path, log] { return window_program::open(path, log); });
}

std::optional<Opened> Background::take_opened() {
  if (!is_ready(opening_))
    return std::nullopt;
  return opening_.get();
}

void Background::save(const Saved_copy& copy, const std::string& path, std::uint64_t edits, bool quits) {
  saving_.push_back(std::async(std::launch::async, [=] {
    Saved saved{path, edits, quits, {}, nullptr};
    try {
      saved.lost = write_copy(*copy, path);
    } catch (...) { // handed on to the window's thread, which tells it
      saved.error = std::current_exception();
    }
    return saved;
  }));
}

std::optional<Background::Saved> Background::take_saved() {
  if (saving_.empty() || !is_ready(saving_.front()))
    return std::nullopt;
  Saved saved = saving_.front().get();
  saving_.erase(saving_.begin());
  return saved;
}

} // namespace haptic_sculpt::window_program
