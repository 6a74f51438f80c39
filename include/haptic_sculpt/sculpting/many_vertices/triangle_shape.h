// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// What makes a triangle worth having, in rounded numbers: nothing here proves anything.

#include <haptic_sculpt/sculpting/geometry/vector_3.h>

#include <limits>

namespace haptic_sculpt::internal {

/// Its length is twice the area.
inline Vector area_normal(const Vector& a, const Vector& b, const Vector& c) {
  return quick_cross(minus(b, a), minus(c, a));
}

/// The square of the sine of the least angle: 0 for a degenerate triangle, at most 3/4.
///
/// The least angle is opposite to the shortest edge: twice the area over the product of the two other edges is its
/// sine.
inline double least_angle_measure(const Vector& a, const Vector& b, const Vector& c) {
  const Vector n = area_normal(a, b, c);
  const double ab = quick_squared_distance(a, b), bc = quick_squared_distance(b, c), ca = quick_squared_distance(c, a);
  const double shortest = smaller(ab, smaller(bc, ca)), longest = larger(ab, larger(bc, ca));
  const double middle = ab + bc + ca - shortest - longest, product = middle * longest;
  return product > 0 ? quick_dot(n, n) / product : 0;
}

/// The square of the distance of p to the point of triangle abc that is nearest to it, as found by rounded numbers:
/// that is a point of the triangle, so no less than the distance, up to the rounding of the square.
inline double squared_distance_to_triangle(const Vector& p, const Vector& a, const Vector& b, const Vector& c) {
  const Vector ab = minus(b, a), ac = minus(c, a), ap = minus(p, a), bp = minus(p, b), cp = minus(p, c);
  const double b_of_a = quick_dot(ab, ap), c_of_a = quick_dot(ac, ap), b_of_b = quick_dot(ab, bp),
               c_of_b = quick_dot(ac, bp), b_of_c = quick_dot(ab, cp), c_of_c = quick_dot(ac, cp);
  const double of_a = b_of_b * c_of_c - b_of_c * c_of_b, of_b = b_of_c * c_of_a - b_of_a * c_of_c,
               of_c = b_of_a * c_of_b - b_of_b * c_of_a;
  const auto to = [&](double along_ab, double along_ac) {
    const Vector d = quick_sum(quick_sum(ap, -along_ab, ab), -along_ac, ac);
    const double square = quick_dot(d, d);
    return square >= 0 ? square : std::numeric_limits<double>::infinity(); // of no triangle, in rounded numbers
  };
  if (b_of_a <= 0 && c_of_a <= 0)
    return to(0, 0);
  if (b_of_b >= 0 && c_of_b <= b_of_b)
    return to(1, 0);
  if (c_of_c >= 0 && b_of_c <= c_of_c)
    return to(0, 1);
  if (of_c <= 0 && b_of_a >= 0 && b_of_b <= 0)
    return to(b_of_a / (b_of_a - b_of_b), 0);
  if (of_b <= 0 && c_of_a >= 0 && c_of_c <= 0)
    return to(0, c_of_a / (c_of_a - c_of_c));
  const double beyond_b = c_of_b - b_of_b, beyond_c = b_of_c - c_of_c;
  if (of_a <= 0 && beyond_b >= 0 && beyond_c >= 0) {
    const double share = beyond_b / (beyond_b + beyond_c);
    return to(1 - share, share);
  }
  const double sum = of_a + of_b + of_c;
  return to(of_b / sum, of_c / sum);
}

/// Whether two vectors differ by less than a right angle.
inline bool point_alike(const Vector& a, const Vector& b) {
  return quick_dot(a, b) > 0;
}

} // namespace haptic_sculpt::internal
