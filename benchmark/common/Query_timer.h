// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <vector>
#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace haptic_sculpt::benchmark {

/// Reads a clock fine enough for single queries: the time stamp counter where there is one, fenced so that nothing of
/// the query is done before or after its turn; else the steady clock.
class Query_timer {
public:
  Query_timer() {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    const std::uint64_t ticks = now();
    while (Clock::now() - begin < std::chrono::milliseconds(50)) {
    }
    const double elapsed = std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
    m_nanoseconds_per_tick = elapsed / static_cast<double>(now() - ticks);
    std::vector<std::uint64_t> empty(10001);
    for (std::uint64_t& e : empty) {
      const std::uint64_t start = now();
      e = now() - start;
    }
    std::nth_element(empty.begin(), empty.begin() + empty.size() / 2, empty.end());
    m_overhead = empty[empty.size() / 2];
    std::uint64_t step = ~std::uint64_t(0);
    for (const std::uint64_t e : empty)
      if (e != m_overhead)
        step = std::min(step, e > m_overhead ? e - m_overhead : m_overhead - e);
    m_resolution = static_cast<double>(step) * m_nanoseconds_per_tick;
  }

  static std::uint64_t now() {
#if defined(__x86_64__)
    _mm_lfence();
    const std::uint64_t ticks = __rdtsc();
    _mm_lfence();
    return ticks;
#else
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
  }

  /// The smallest difference between two timings of nothing, in nanoseconds: single times are no finer than this.
  double resolution() const { return m_resolution; }

  /// What timing nothing takes, in nanoseconds.
  double overhead() const { return static_cast<double>(m_overhead) * m_nanoseconds_per_tick; }

  /// The duration of what ran between two calls of now(), less what timing nothing takes.
  double nanoseconds(std::uint64_t start, std::uint64_t end) const {
    return end - start <= m_overhead ? 0 : static_cast<double>(end - start - m_overhead) * m_nanoseconds_per_tick;
  }

private:
  double m_nanoseconds_per_tick = 1, m_resolution = 0;
  std::uint64_t m_overhead = 0;
};

} // namespace haptic_sculpt::benchmark
