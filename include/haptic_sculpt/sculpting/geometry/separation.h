// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Lower bounds of distances by separating planes. Whatever direction n they have, min n . p over one set less max n .
/// q over the other, over |n|, is no more than the distance of the two hulls. So n may be found by rounded numbers,
/// degenerate cases and all.

#include <haptic_sculpt/sculpting/geometry/vector_3.h>

#include <array>
#include <limits>

namespace haptic_sculpt::internal {

/// How far two sets of points are apart along n, at least, up to the roundings of the sums; 0 where that is not known.
/// Where |n|, as a rule the distance itself, is no more than `least`, roundings are all of it.
template <std::size_t N, std::size_t M>
double separation(const std::array<Vector, N>& ps, const std::array<Vector, M>& qs, const Vector& n, double least) {
  const double norm = std::sqrt(quick_dot(n, n));
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Vector& p : ps)
    lowest = smaller(lowest, quick_dot(n, p));
  for (const Vector& q : qs)
    highest = larger(highest, quick_dot(n, q));
  const double apart = (lowest - highest) / norm;
  return norm > least && apart > 0 ? apart : 0;
}

/// About the point of the segment nearest to the origin.
inline Vector nearest_to_origin(const Vector& a, const Vector& b) {
  const Vector d = minus(b, a);
  const double t = -quick_dot(a, d) / quick_dot(d, d);
  return t <= 0 ? a : t >= 1 ? b : quick_sum(a, t, d);
}

/// About the point of the triangle nearest to the origin.
inline Vector nearest_to_origin(const std::array<Vector, 3>& t) {
  const Vector n = quick_cross(minus(t[1], t[0]), minus(t[2], t[0]));
  bool inside = true;
  for (int k = 0; k < 3; ++k)
    inside = inside && quick_dot(quick_cross(t[k], t[(k + 1) % 3]), n) >= 0;
  if (inside)
    return scaled(n, quick_dot(t[0], n) / quick_dot(n, n));
  Vector best = nearest_to_origin(t[0], t[1]);
  for (int k = 1; k < 3; ++k) {
    const Vector other = nearest_to_origin(t[k], t[(k + 1) % 3]);
    if (quick_dot(other, other) < quick_dot(best, best))
      best = other;
  }
  return best;
}

/// About the shortest vector from the second segment to the first.
inline Vector between_segments(const std::array<Vector, 2>& p, const std::array<Vector, 2>& q) {
  const Vector d = minus(p[1], p[0]), e = minus(q[1], q[0]), r = minus(p[0], q[0]);
  const double dd = quick_dot(d, d), ee = quick_dot(e, e), de = quick_dot(d, e), dr = quick_dot(d, r),
               er = quick_dot(e, r);
  const double determinant = dd * ee - de * de;
  const auto clamped = [](double x) { return x > 0 ? x < 1 ? x : 1 : 0; };
  double s = determinant > 0 ? clamped((de * er - ee * dr) / determinant) : 0;
  const double t = clamped((de * s + er) / ee);
  s = clamped((de * t - dr) / dd);
  return minus(quick_sum(p[0], s, d), quick_sum(q[0], t, e));
}

} // namespace haptic_sculpt::internal
