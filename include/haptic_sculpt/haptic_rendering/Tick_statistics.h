// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace haptic_sculpt {

/// Percentiles of durations in nanoseconds, of any number of them, in 16 KiB and without an allocation.
///
/// Durations are counted in 32 classes an octave, so a percentile is at most 3.2 % too large; the largest one is exact.
class Tick_statistics {
public:
  /// Counts a duration. A few operations, no allocation.
  void add(std::uint64_t nanoseconds) {
    ++counts_[index_of(nanoseconds)];
    ++number_;
    largest_ = nanoseconds > largest_ ? nanoseconds : largest_;
  }

  std::uint64_t number() const { return number_; }   ///< of durations
  std::uint64_t largest() const { return largest_; } ///< ns, exact; 0 where there are none

  /// The least bound, ns, that a share of the durations keep: 0.5 the median, 0.999 all but one in a thousand. 0 where
  /// there are none.
  std::uint64_t percentile(double share) const {
    const double wanted = std::ceil(share * static_cast<double>(number_));
    std::uint64_t seen = 0;
    for (std::size_t i = 0; i < counts_.size() && number_ > 0; ++i) {
      seen += counts_[i];
      if (static_cast<double>(seen) >= wanted && seen > 0)
        return upper_bound(i) < largest_ ? upper_bound(i) : largest_;
    }
    return largest_;
  }

private:
  static constexpr int bits = 5; ///< classes an octave: 2^bits
  std::array<std::uint64_t, std::size_t(65 - bits) << bits> counts_{};
  std::uint64_t number_ = 0, largest_ = 0;

  static int octave_of(std::uint64_t n) {
    int octave = 0;
    for (std::uint64_t rest = n >> (bits + 1); rest != 0; rest >>= 1)
      ++octave;
    return octave;
  }
  /// Below 2^(bits + 1) each number has a class of its own.
  static std::size_t index_of(std::uint64_t n) {
    const int octave = octave_of(n);
    return (std::size_t(octave) << bits) + static_cast<std::size_t>(n >> octave);
  }
  static std::uint64_t upper_bound(std::size_t index) {
    const std::size_t size = std::size_t(1) << bits;
    if (index < 2 * size)
      return index;
    const std::size_t octave = (index >> bits) - 1;
    const std::uint64_t leading = index - (octave << bits);
    return ((leading + 1) << octave) - 1;
  }
};

} // namespace haptic_sculpt
