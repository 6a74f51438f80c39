// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace haptic_sculpt::sculpt_program {

/// Says on standard error that something goes on that cannot tell how far it is: after 2, 4, 8, ... seconds of its
/// life.
class Patience {
public:
  /// \param what goes on, e.g. "repairing 'x.off'"
  explicit Patience(std::string what) : what_(std::move(what)), thread_([this] { wait(); }) {}
  Patience(const Patience&) = delete;
  Patience& operator=(const Patience&) = delete;
  ~Patience() {
    {
      const std::lock_guard lock(mutex_);
      is_done_ = true;
    }
    done_.notify_one();
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
