// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Tick_statistics.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <ctime>

namespace haptic_sculpt::loop_program {

inline std::uint64_t nanoseconds(clockid_t clock) {
  timespec now;
  clock_gettime(clock, &now);
  return static_cast<std::uint64_t>(now.tv_sec) * 1000000000u + static_cast<std::uint64_t>(now.tv_nsec);
}

/// When ticks begin: at absolute times, so that what one is late the next are not.
class Tick_clock {
public:
  /// \param tick s \param most_late what is made up for, s; at least a tick
  Tick_clock(double tick, double most_late)
      : tick_(static_cast<std::uint64_t>(1e9 * tick))
      , most_late_(static_cast<std::uint64_t>(1e9 * most_late))
      , due_(nanoseconds(CLOCK_MONOTONIC)) {}

  /// Waits for the next tick. After a longer pause the clock begins anew: its ticks, made up for at once, would be more
  /// than a log can take. \param missed ticks begun more than a tick after their time, or left out in a pause
  void wait(const std::atomic<bool>& is_interrupted, Tick_statistics& wakeup, std::uint64_t& missed) {
    due_ += tick_;
    const timespec until{static_cast<std::time_t>(due_ / 1000000000u), static_cast<long>(due_ % 1000000000u)};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR && !is_interrupted)
      ;
    const std::uint64_t now = nanoseconds(CLOCK_MONOTONIC), late = now > due_ ? now - due_ : 0;
    wakeup.add(late);
    if (late > most_late_)
      missed += late / tick_, due_ = now;
    else
      missed += late > tick_;
  }

private:
  std::uint64_t tick_, most_late_, due_; // ns
};

} // namespace haptic_sculpt::loop_program
