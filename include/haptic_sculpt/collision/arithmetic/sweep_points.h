// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/Sweep_verdict.h>

#include <cmath>

namespace haptic_sculpt::internal {

template <class Point_3>
Coordinates coordinates(const Point_3& p) {
  return {p.x(), p.y(), p.z()};
}

template <class Point_3>
Sweep_points sweep_points(const Point_3& s, const Point_3& t, const Point_3& a, const Point_3& b, const Point_3& c) {
  return {coordinates(s), coordinates(t), coordinates(a), coordinates(b), coordinates(c)};
}

template <std::size_t size>
bool are_finite(const std::array<Coordinates, size>& points) {
  for (const Coordinates& p : points)
    for (double x : p)
      if (!std::isfinite(x))
        return false;
  return true;
}

} // namespace haptic_sculpt::internal
