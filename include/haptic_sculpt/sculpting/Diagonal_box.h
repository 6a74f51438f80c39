// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_DIAGONAL_BOX_H
#define HAPTIC_SCULPT_SCULPTING_DIAGONAL_BOX_H

#include <array>
#include <limits>

namespace haptic_sculpt {
namespace internal {

/// Bounds of some points along the six diagonals (1, 1, 0), (1, -1, 0), ...: with an ordinary box a polytope of
/// eighteen sides.
///
/// Two faces that lean on each other like the sides of a roof are told apart by it, which boxes never do; in the star
/// of a thousand faces every face leans on all others. A rounded sum grows with the exact one, in every rounding mode.
/// So when all sums of one set are above all of another, rounded, they are, exactly; comparing the rounded ones decides
/// nothing wrongly.
struct Diagonal_box {
  using Coordinates = std::array<double, 3>;
  using Bounds = std::array<double, 6>;

  Bounds lower, upper;

  template <class... Points>
  explicit Diagonal_box(const Coordinates& first, const Points&... others) : lower(sums(first)), upper(lower) {
    (include(others), ...);
  }

  Diagonal_box& include(const Coordinates& p) {
    const Bounds s = sums(p);
    for (int i = 0; i < 6; ++i) {
      lower[i] = s[i] < lower[i] ? s[i] : lower[i];
      upper[i] = s[i] > upper[i] ? s[i] : upper[i];
    }
    return *this;
  }

  /// Whether the hull of the points certainly has no point in common with what is in here.
  template <class... Points>
  bool excludes(const Points&... points) const {
    const Diagonal_box other(points...);
    bool apart = false;
    for (int i = 0; i < 6; ++i)
      apart |= (other.lower[i] > upper[i]) | (other.upper[i] < lower[i]);
    return apart;
  }

  /// Makes room for all that is no farther than `margin` (rounded). The diagonals have the length sqrt 2.
  void inflate(double margin) {
    for (int i = 0; i < 6; ++i)
      lower[i] -= 1.4142136 * margin, upper[i] += 1.4142136 * margin;
  }

private:
  static Bounds sums(const Coordinates& p) {
    return {p[0] + p[1], p[0] - p[1], p[0] + p[2], p[0] - p[2], p[1] + p[2], p[1] - p[2]};
  }
};

/// Excludes nothing: where a pair is known to be near.
struct No_box {
  template <class... Points>
  bool excludes(const Points&...) const {
    return false;
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
