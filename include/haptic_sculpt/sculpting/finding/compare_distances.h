// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/Filter_counters.h>
#include <haptic_sculpt/collision/arithmetic/exact_integers.h>
#include <haptic_sculpt/sculpting/geometry/vector_3.h>

namespace haptic_sculpt::internal {

/// The squares of two lengths, rounded: whether these tell which is larger. A square is off by less than 2^-50 of
/// itself; where it is below the least, by what underflows, which is less still than 2^-50 of the least.
inline bool are_told_apart(double a, double b) {
  constexpr double least = 0x1p-900, largest = 0x1p1000;
  const double larger = a > b ? a : b, difference = a > b ? a - b : b - a;
  return larger >= least && larger <= largest && difference > 0x1p-48 * larger;
}

/// Of the distance times `unit`, a power of two: one that is right for the scene keeps squares in the range of doubles.
inline double rounded_square(const Coordinates& p, const Coordinates& q, double unit) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double d = (q[i] - p[i]) * unit;
    sum += d * d;
  }
  return sum;
}

template <class Integer>
auto exact_square(const std::array<Integer, 3>& p, const std::array<Integer, 3>& q) {
  const Integer x = q[0] - p[0], y = q[1] - p[1], z = q[2] - p[2];
  return x * x + y * y + z * z;
}

/// The sign of |a - p| - |b - p|; exact. Integers of n limbs have two bits more than differences need
/// (exact_integers.h), so three squares of them, and their difference from three others, fit in 2n limbs.
/// \param unit see rounded_square(); changes no answer
inline int compare_distances(const Coordinates& p, const Coordinates& a, const Coordinates& b, double unit = 1) {
  const double to_a = rounded_square(p, a, unit), to_b = rounded_square(p, b, unit);
  if (are_told_apart(to_a, to_b))
    return to_a < to_b ? -1 : 1;
  Exponent_range range;
  range.include(p), range.include(a), range.include(b);
  No_filter_counters uncounted;
  return with_exact_integers(range, uncounted, [&](auto type) {
    using Integer = decltype(type);
    const auto integers = [&](const Coordinates& q) { return to_integers<Integer>(q, range.lowest); };
    const auto from = integers(p);
    return sign_of(exact_square<Integer>(from, integers(a)) - exact_square<Integer>(from, integers(b)));
  });
}

/// The sign of |a - p| - length; exact. \pre length >= 0; may be infinite
inline int compare_distance(const Coordinates& p, const Coordinates& a, double length, double unit = 1) {
  if (std::isinf(length))
    return -1;
  const double square = rounded_square(p, a, unit), limit = (length * unit) * (length * unit);
  if (are_told_apart(square, limit))
    return square < limit ? -1 : 1;
  Exponent_range range;
  range.include(p), range.include(a), range.include(length);
  No_filter_counters uncounted;
  return with_exact_integers(range, uncounted, [&](auto type) {
    using Integer = decltype(type);
    const Integer l = Integer_of_double<Integer>::convert(length, range.lowest);
    return sign_of(exact_square<Integer>(to_integers<Integer>(p, range.lowest), to_integers<Integer>(a, range.lowest)) -
                   l * l);
  });
}

} // namespace haptic_sculpt::internal
