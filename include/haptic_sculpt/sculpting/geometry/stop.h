// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/geometry/contact_plane.h>

namespace haptic_sculpt::internal {

/// How far back along the path, as a length, a stop stays from the impact so that `clearance` is left normal to the
/// contact plane. Where the path lies in the plane there is no normal way: the clearance itself.
inline double setback(double clearance, double sine) { return sine > 0 ? clearance / sine : clearance; }

/// A point of the path, rounded, that never leaves the box of its ends.
inline Coordinates point_of_path(const Coordinates& source, const Coordinates& target, double fraction) {
  Coordinates q;
  for (int i = 0; i < 3; ++i) {
    const double extent = target[i] - source[i];
    // An extent that overflows is formed from halves.
    q[i] = std::isfinite(extent) ? std::fma(fraction, extent, source[i])
                                 : 2 * std::fma(fraction, target[i] / 2 - source[i] / 2, source[i] / 2);
    const double low = std::fmin(source[i], target[i]), high = std::fmax(source[i], target[i]);
    q[i] = q[i] < low ? low : q[i] > high ? high : q[i];
  }
  return q;
}

/// The length of the path; may overflow to infinity.
inline double path_length(const Coordinates& source, const Coordinates& target) {
  return 2 * length(minus(scaled(target, 0.5), scaled(source, 0.5)));
}

/// Stops short of an impact at time u, at least `setback` before it, at a rounded point to which the way is proven
/// free.
///
/// `is_free(Q)` decides exactly whether the motion from source to Q touches nothing. The setback doubles until it does;
/// at the latest Q = source, which is no motion, ends it. (doc/proofs/stop.md)
template <class Is_free>
Coordinates stop_before(const Coordinates& source, const Coordinates& target, double time, double setback,
                        const Is_free& is_free) {
  const double length = path_length(source, target);
  // A clearance below the smallest double would never grow.
  for (double back = std::fmax(setback, std::numeric_limits<double>::denorm_min()); back < time * length; back *= 2) {
    const Coordinates q = point_of_path(source, target, time - back / length);
    if (q == source)
      break;
    if (is_free(q))
      return q;
  }
  return source;
}

} // namespace haptic_sculpt::internal
