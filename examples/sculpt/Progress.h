// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../common/Printable_stream.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include <unistd.h>

namespace haptic_sculpt::sculpt_program {

/// Says on standard error that something goes on, and how far it is, from a thread of its own: a line of a script may
/// take long, too. Nothing in the first two seconds of its life; then at 2, 4, 8, ... seconds, so that the log of a
/// night's run stays short; on a terminal lines of a script are counted twice a second, in one line.
class Progress {
public:
  /// \param what goes on, e.g. "repairing 'x.off'" \param total of how many lines; 0: it cannot tell how far it is
  explicit Progress(std::string what, std::size_t total = 0)
      : what_(std::move(what)), total_(total), is_in_one_line_(total > 0 && ::isatty(STDERR_FILENO) == 1) {
    try {
      thread_ = std::thread([this] {
        try {
          wait();
        } catch (const std::exception&) { // no memory: what goes on does without being told
        }
      });
    } catch (const std::exception&) { // no more threads, or memory: what goes on does without being told
    }
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() {
    {
      const std::lock_guard lock(mutex_);
      has_ended_ = true;
    }
    ended_.notify_one();
    if (thread_.joinable())
      thread_.join();
    if (is_in_one_line_ && has_said_)
      say("\n");
  }

  void step(std::size_t done) { done_.store(done, std::memory_order_relaxed); } ///< lines

private:
  void wait() {
    const auto begin = std::chrono::steady_clock::now();
    std::unique_lock lock(mutex_);
    for (std::chrono::milliseconds next(2000); !ended_.wait_until(lock, begin + next, [this] { return has_ended_; });
         next = is_in_one_line_ ? next + std::chrono::milliseconds(500) : 2 * next) {
      const std::string far = total_ > 0 ? ": " + std::to_string(done_.load(std::memory_order_relaxed)) + " of " +
                                               std::to_string(total_) + " lines"
                                         : "";
      say((is_in_one_line_ ? "\r" : "") + ("sculpt: " + what_) + far + ", " + std::to_string(next.count() / 1000) +
          " s" + (is_in_one_line_ ? "" : "\n"));
      has_said_ = true;
    }
  }

  /// All at once, past std::cerr, which is the other thread's. What cannot be written is nobody's loss.
  static void say(const std::string& text) {
    std::ostringstream printed;
    {
      const examples::Printable_stream printable(printed);
      printed << text;
    }
    const std::string bytes = printed.str();
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, bytes.data(), bytes.size());
  }

  const std::string what_;
  const std::size_t total_;
  const bool is_in_one_line_;
  std::atomic<std::size_t> done_{0};
  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false, has_said_ = false;
  std::thread thread_; // last: it uses the others
};

} // namespace haptic_sculpt::sculpt_program
