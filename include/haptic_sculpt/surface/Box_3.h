// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <limits>

namespace haptic_sculpt {

/// A closed axis-parallel box of doubles. Its comparisons round nothing, so they are exact where
/// subnormal numbers are not flushed.
struct Box_3 {
  using Coordinates = std::array<double, 3>; ///< x, y, z

  /// The least x, y, z; +infinity in the box that holds nothing.
  Coordinates lower{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::infinity()};
  /// The largest x, y, z; -infinity in the box that holds nothing.
  Coordinates upper{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()};

  /// The box that holds nothing; it meets no box.
  Box_3() = default;
  /// The box of one point.
  explicit Box_3(const Coordinates& p) : lower(p), upper(p) {}

  /// Grows as little as it must to hold the point. Returns itself.
  Box_3& include(const Coordinates& p) {
    for (int i = 0; i < 3; ++i) {
      lower[i] = p[i] < lower[i] ? p[i] : lower[i];
      upper[i] = p[i] > upper[i] ? p[i] : upper[i];
    }
    return *this;
  }

  /// Grows as little as it must to hold the other box. Returns itself.
  Box_3& include(const Box_3& other) {
    for (int i = 0; i < 3; ++i) {
      lower[i] = other.lower[i] < lower[i] ? other.lower[i] : lower[i];
      upper[i] = other.upper[i] > upper[i] ? other.upper[i] : upper[i];
    }
    return *this;
  }

  /// Whether every point of the other box is one of this: so, too, where the other holds none.
  bool contains(const Box_3& other) const {
    bool inside = true;
    for (int i = 0; i < 3; ++i)
      inside &= int(lower[i] <= other.lower[i]) & int(other.upper[i] <= upper[i]);
    return inside;
  }
};

/// Whether the point lies in the closed box.
inline bool contains(const Box_3& box, const Box_3::Coordinates& p) {
  bool inside = true;
  for (int i = 0; i < 3; ++i)
    inside &= int(box.lower[i] <= p[i]) & int(p[i] <= box.upper[i]);
  return inside;
}

/// Whether the closed boxes have a point in common.
inline bool do_meet(const Box_3& a, const Box_3& b) {
  bool meet = true;
  for (int i = 0; i < 3; ++i)
    meet &= int(a.lower[i] <= b.upper[i]) & int(b.lower[i] <= a.upper[i]);
  return meet;
}

} // namespace haptic_sculpt
