// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/exact_integers.h>
#include <haptic_sculpt/sculpting/geometry/vector_3.h>

#include <CGAL/Gmpq.h>

namespace haptic_sculpt::internal {

/// What nearer_by() may be wrong by, in lengths of the way: some ten roundings, of differences, sums and products, by
/// 2^-53 each, with room.
constexpr double rounding_of_nearer_by = 0x1p-47;

/// Whether p is farther from `target` than q is; exact. \pre finite
///
/// |T - p|^2 - |T - q|^2 = (q - p) . (2 T - p - q).
inline bool is_farther(const Coordinates& target, const Coordinates& p, const Coordinates& q) {
  if (p == q)
    return false;
  const double gain = nearer_by(target, q, p), error = rounding_of_nearer_by * length(minus(p, q));
  if (std::abs(gain) > error && error > 0x1p-1000) // else products may have lost digits to underflow
    return gain < 0;
  CGAL::Gmpq sum(0);
  for (int i = 0; i < 3; ++i) {
    const CGAL::Gmpq a(p[i]), b(q[i]), t(target[i]);
    sum += (b - a) * (t + t - a - b);
  }
  return CGAL::sign(sum) == CGAL::POSITIVE;
}

} // namespace haptic_sculpt::internal
