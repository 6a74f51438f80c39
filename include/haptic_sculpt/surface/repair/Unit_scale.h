// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <algorithm>
#include <cmath>

namespace haptic_sculpt::internal {

/// A power of two that brings very large or very small coordinates near 1, where squares and volumes, which CGAL's
/// constructions round, neither overflow nor vanish. 1 where a coordinate would lose a bit by it, or there is no need.
class Unit_scale {
  static constexpr int widest = 100; ///< binary exponents up to this are left as they are: a sixth power stays in range

public:
  /// \pre the points are finite
  explicit Unit_scale(const Face_soup& soup) {
    double largest = 0;
    for (const auto& p : soup.points)
      largest = std::max({largest, std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
    if (largest == 0 || std::abs(std::ilogb(largest)) <= widest)
      return;
    exponent_ = std::ilogb(largest);
    for (const auto& p : soup.points)
      for (int k = 0; k < 3; ++k)
        if (up(down(p[k])) != p[k]) {
          exponent_ = 0;
          return;
        }
  }

  double down(double x) const { return std::ldexp(x, -exponent_); }
  double up(double x) const { return std::ldexp(x, exponent_); }
  void down(Face_soup& soup) const { scale(soup, -exponent_); }
  void up(Face_soup& soup) const { scale(soup, exponent_); }

private:
  static void scale(Face_soup& soup, int exponent) {
    if (exponent != 0)
      for (auto& p : soup.points)
        p = Face_soup::Point_3(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent));
  }

  int exponent_ = 0;
};

} // namespace haptic_sculpt::internal
