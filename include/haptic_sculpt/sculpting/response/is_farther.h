// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/Filter_counters.h>
#include <haptic_sculpt/collision/arithmetic/exact_integers.h>
#include <haptic_sculpt/sculpting/geometry/vector_3.h>

namespace haptic_sculpt::internal {

/// What nearer_by() may be wrong by, in lengths of the way: some ten roundings, of differences, sums and products, by
/// 2^-53 each, with room.
constexpr double rounding_of_nearer_by = 0x1p-47;

/// Whether p is farther from `target` than q is; exact. \pre finite
///
/// |T - p|^2 - |T - q|^2 = (q - p) . (2 T - p - q). Integers of n limbs have room for a sum of two differences
/// (exact_integers.h), and three products of these for 2n limbs.
inline bool is_farther(const Coordinates& target, const Coordinates& p, const Coordinates& q) {
  if (p == q)
    return false;
  const double gain = nearer_by(target, q, p), error = rounding_of_nearer_by * length(minus(p, q));
  if (std::abs(gain) > error && error > 0x1p-1000) // else products may have lost digits to underflow
    return gain < 0;
  Exponent_range range;
  range.include(target), range.include(p), range.include(q);
  No_filter_counters uncounted;
  return with_exact_integers(range, uncounted, [&](auto type) {
    using Integer = decltype(type);
    const auto integers = [&](const Coordinates& x) { return to_integers<Integer>(x, range.lowest); };
    const auto a = integers(p), b = integers(q), t = integers(target);
    const auto share = [&](int i) { return (b[i] - a[i]) * ((t[i] - a[i]) + (t[i] - b[i])); };
    return sign_of(share(0) + share(1) + share(2)) > 0;
  });
}

} // namespace haptic_sculpt::internal
