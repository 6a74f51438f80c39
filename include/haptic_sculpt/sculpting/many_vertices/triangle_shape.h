// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_TRIANGLE_SHAPE_H
#define HAPTIC_SCULPT_SCULPTING_TRIANGLE_SHAPE_H

/// \file
/// What makes a triangle worth having, in rounded numbers: nothing here proves anything.

#include <haptic_sculpt/sculpting/culling/separation.h>

namespace haptic_sculpt {
namespace internal {

inline double squared_length(const Vector& a, const Vector& b) {
  const Vector d = minus(a, b);
  return quick_dot(d, d);
}

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
  const double ab = squared_length(a, b), bc = squared_length(b, c), ca = squared_length(c, a);
  const double shortest = smaller(ab, smaller(bc, ca)), longest = larger(ab, larger(bc, ca));
  const double middle = ab + bc + ca - shortest - longest, product = middle * longest;
  return product > 0 ? quick_dot(n, n) / product : 0;
}

/// Whether two vectors differ by less than a right angle.
inline bool point_alike(const Vector& a, const Vector& b) {
  return quick_dot(a, b) > 0;
}

} // namespace internal
} // namespace haptic_sculpt

#endif
