// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_COLLISION_FILTER_COUNTERS_H
#define HAPTIC_SCULPT_COLLISION_FILTER_COUNTERS_H

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

  void count_permanent() { ++permanent; }
  void count_integer_64() { ++integer_64; }
  void count_integer_128() { ++integer_128; }
  void count_integer_256() { ++integer_256; }
  void count_big_integer() { ++big_integer; }

  /// Signs that the first, unscaled stage in doubles could not decide.
  std::uint64_t failures() const { return permanent + integer_64 + integer_128 + integer_256 + big_integer; }

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
  void count_permanent() {}
  void count_integer_64() {}
  void count_integer_128() {}
  void count_integer_256() {}
  void count_big_integer() {}
};

} // namespace haptic_sculpt

#endif
