// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace haptic_sculpt::internal {

/// A power of two that brings very large or very small coordinates near 1, where squares and volumes, which CGAL's
/// constructions round, neither overflow nor vanish. 1 where a coordinate or the gap would lose a bit by it, or there
/// is no need. Only points of faces count.
class Unit_scale {
  static constexpr int widest = 100; ///< binary exponents up to this are left as they are: a sixth power stays in range

public:
  /// \pre the points are finite
  Unit_scale(const Face_soup& soup, std::optional<double> gap) {
    double largest = 0;
    for (const auto corner : soup.corners)
      for (int k = 0; k < 3; ++k)
        largest = std::max(largest, std::abs(soup.points[corner][k]));
    if (largest == 0 || std::abs(std::ilogb(largest)) <= widest)
      return;
    exponent_ = std::ilogb(largest);
    if (gap && std::isnormal(*gap) && std::fpclassify(down(*gap)) == FP_SUBNORMAL) // it may be another one
      exponent_ = 0;
    for (const auto corner : soup.corners)
      for (int k = 0; k < 3; ++k)
        if (const double x = soup.points[corner][k]; up(down(x)) != x) {
          exponent_ = 0;
          return;
        }
  }

  double down(double x) const { return std::ldexp(x, -exponent_); }
  double up(double x) const { return std::ldexp(x, exponent_); }
  /// Points that no face has stay where they are: no number may hold where they would come to.
  void down(Face_soup& soup) const {
    std::vector<bool> has_face(soup.points.size(), false);
    for (const auto corner : soup.corners)
      has_face[corner] = true;
    for (std::size_t v = 0; v < soup.points.size(); ++v)
      if (has_face[v])
        scale(soup.points[v], -exponent_);
  }
  /// \pre points that down() left where they were are gone
  void up(Face_soup& soup) const {
    for (auto& p : soup.points)
      scale(p, exponent_);
  }

private:
  static void scale(Face_soup::Point_3& p, int exponent) {
    p = Face_soup::Point_3(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent));
  }

  int exponent_ = 0;
};

} // namespace haptic_sculpt::internal
