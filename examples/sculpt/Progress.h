// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <iostream>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include <unistd.h>

namespace haptic_sculpt::sculpt_program {

/// Says on standard error how far a long run is. Nothing in the first two seconds; then a terminal reads it twice a
/// second in one line, and a file at 2, 4, 8, ... seconds, so that the log of a night's run stays short.
class Progress {
public:
  explicit Progress(std::size_t total) : total_(total), is_terminal_(::isatty(STDERR_FILENO) == 1) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() {
    if (is_terminal_ && said_)
      std::cerr << '\n';
  }

  void step(std::size_t done) {
    const auto elapsed = Clock::now() - begin_;
    if (elapsed < next_)
      return;
    next_ = is_terminal_ ? elapsed + std::chrono::milliseconds(500) : 2 * elapsed;
    said_ = true;
    std::cerr << (is_terminal_ ? "\r" : "") << "sculpt: " << done << " of " << total_ << " lines, "
              << std::chrono::duration_cast<std::chrono::seconds>(elapsed).count() << " s" << (is_terminal_ ? "" : "\n")
              << std::flush;
  }

private:
  using Clock = std::chrono::steady_clock;
  std::size_t total_;
  bool is_terminal_, said_ = false;
  Clock::time_point begin_ = Clock::now();
  Clock::duration next_ = std::chrono::seconds(2);
};

/// Says on standard error that something goes on that cannot tell how far it is: after 2, 4, 8, ... seconds of its
/// life.
class Patience {
public:
  /// \param what goes on, e.g. "repairing 'x.off'"
  explicit Patience(std::string what) : what_(std::move(what)) {
    try {
      thread_ = std::thread([this] { wait(); });
    } catch (const std::system_error&) { // no more threads: what goes on does without being told
    }
  }
  Patience(const Patience&) = delete;
  Patience& operator=(const Patience&) = delete;
  ~Patience() {
    {
      const std::lock_guard lock(mutex_);
      is_done_ = true;
    }
    done_.notify_one();
    if (thread_.joinable())
      thread_.join();
  }

private:
  void wait() {
    const auto begin = std::chrono::steady_clock::now();
    std::unique_lock lock(mutex_);
    for (std::chrono::seconds elapsed(2); !done_.wait_until(lock, begin + elapsed, [this] { return is_done_; });
         elapsed *= 2)
      std::cerr << "sculpt: " + what_ + ", " + std::to_string(elapsed.count()) + " s\n" << std::flush;
  }

  const std::string what_;
  std::mutex mutex_;
  std::condition_variable done_;
  bool is_done_ = false;
  std::thread thread_; // last: it uses the others
};

} // namespace haptic_sculpt::sculpt_program
