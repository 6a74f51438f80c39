// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_CLEARANCE_H
#define HAPTIC_SCULPT_SCULPTING_CLEARANCE_H

#include <cmath>
#include <limits>

namespace haptic_sculpt {

/// How many units in the last place of the scene's largest coordinate a stop keeps from a contact plane by default.
/// Measured (doc/stop.md): below 3 a rounded stop often fails its proof and retries; above 4 nothing is gained.
constexpr double default_clearance_ulps = 4;

/// The distance from |x| to the next larger double; 0 for infinities.
inline double unit_in_the_last_place(double x) {
  x = std::abs(x);
  return std::isfinite(x) ? (x < std::numeric_limits<double>::max() ? std::nextafter(x, std::numeric_limits<double>::infinity()) - x
                                                                    : x - std::nextafter(x, 0.0))
                          : 0;
}

/// The default clearance, a length, for a scene whose largest coordinate is `largest_coordinate`.
inline double default_clearance(double largest_coordinate) {
  return default_clearance_ulps * unit_in_the_last_place(largest_coordinate);
}

} // namespace haptic_sculpt

#endif
