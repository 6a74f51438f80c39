// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace haptic_sculpt {

/// How many signs left each stage of the filter. A stage is entered only when the one before could not decide.
///
/// One object serves one thread; add up several with `operator+=`.
struct Filter_counters {
  std::uint64_t permanent = 0;    ///< decided in doubles by the tighter bound of the second stage
  std::uint64_t integer_64 = 0;   ///< decided in integers, one 64-bit limb a coordinate
  std::uint64_t integer_128 = 0;  ///< decided in integers, two limbs a coordinate
  std::uint64_t integer_256 = 0;  ///< decided in integers, four limbs a coordinate
  std::uint64_t big_integer = 0;  ///< decided in GMP integers: coordinates more than 2^199 apart in size

  void count_permanent() { ++permanent; }     ///< one sign more, found in doubles; called by the sweeps
  void count_integer_64() { ++integer_64; }   ///< one more, found in one limb; a comparison of times counts as well
  void count_integer_128() { ++integer_128; } ///< one more, found in two limbs
  void count_integer_256() { ++integer_256; } ///< one more, found in four limbs
  void count_big_integer() { ++big_integer; } ///< one more, found in GMP integers

  /// Signs that the first, unscaled stage in doubles could not decide.
  std::uint64_t failures() const { return permanent + integer_64 + integer_128 + integer_256 + big_integer; }

  /// Adds every count of another object, such as another thread's.
  Filter_counters& operator+=(const Filter_counters& other) {
    permanent += other.permanent;
    integer_64 += other.integer_64;
    integer_128 += other.integer_128;
    integer_256 += other.integer_256;
    big_integer += other.big_integer;
    return *this;
  }
};

/// Counts nothing and costs nothing.
struct No_filter_counters {
  void count_permanent() {}   ///< counts nothing
  void count_integer_64() {}  ///< counts nothing
  void count_integer_128() {} ///< counts nothing
  void count_integer_256() {} ///< counts nothing
  void count_big_integer() {} ///< counts nothing
};

} // namespace haptic_sculpt
