// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// What makes a triangle worth having, in rounded numbers: nothing here proves anything.

#include <haptic_sculpt/sculpting/geometry/vector_3.h>

#include <CGAL/Gmpq.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace haptic_sculpt::internal {

/// Its length is twice the area.
inline Vector area_normal(const Vector& a, const Vector& b, const Vector& c) {
  return quick_cross(minus(b, a), minus(c, a));
}

/// Of length 1, right up to some roundings however thin the triangle is; 0 where that is degenerate, or too far out for
/// its unit.
inline Vector unit_normal(const Vector& a, const Vector& b, const Vector& c) {
  constexpr double least_share = 0x1p-20;   // of the product of two edges: a thinner triangle's has lost too many bits
  constexpr double least_length = 0x1p-900; // so has a shorter one, being subnormal
  const Vector n = area_normal(a, b, c);
  if (length(n) > least_length && length(n) > least_share * length(minus(b, a)) * length(minus(c, a)))
    return normalized(n);
  for (const Vector& p : {a, b, c})
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      return {0, 0, 0};
  using Number = CGAL::Gmpq;
  std::array<Number, 3> u, v, exact;
  for (std::size_t i = 0; i < 3; ++i)
    u[i] = Number(b[i]) - Number(a[i]), v[i] = Number(c[i]) - Number(a[i]);
  Number largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    exact[i] = u[j] * v[k] - u[k] * v[j];
    largest = std::max(largest, CGAL::abs(exact[i]));
  }
  if (largest == 0)
    return {0, 0, 0};
  const auto rounded = [&](const Number& x) { return CGAL::to_double(Number(x / largest)); };
  return normalized({rounded(exact[0]), rounded(exact[1]), rounded(exact[2])});
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
