// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/axis_sweep.h>

#include <CGAL/FPU.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>

namespace haptic_sculpt::internal {

/// Whether q(t) = |n|^2 - delta^2 |side|^2 >= 0 for all t in [0, 1], for each side of the triangle 0, 1, 2; n is the
/// normal, a cross product of two sides. One coordinate of n is constant and two are affine in t, so q is a quadratic
/// a t^2 + b t + c, and nothing but signs is asked. Where q(0) < 0 the altitude h = |n| / |side| must not shrink: then
/// |n|^2 |side(0)|^2 - |n(0)|^2 |side|^2 takes the place of q (doc/proofs/axis_moves.md).
template <class Number>
CGAL::Uncertain<bool> is_delta_kept_in(const Axis_motion<3>& motion, double delta) {
  struct Affine { // start + t slope
    Number start, slope;
  };
  struct Quadratic {
    Number a = 0, b = 0, c = 0;
    void add_square(const Affine& x, const Number& factor) {
      a += factor * x.slope * x.slope;
      b += factor * 2 * x.start * x.slope;
      c += factor * x.start * x.start;
    }
  };
  constexpr int i = 0, j = 1, k = 2;
  const auto difference = [&](int from, int to, int coordinate) {
    const auto now = [&](int at) { return Number(motion.places[to][at]) - Number(motion.places[from][at]); };
    const Number start = now(coordinate);
    return Affine{start, coordinate == k ? Number(now(k + 1) - start) : Number(0)};
  };
  const Number one(1), square = Number(delta) * Number(delta);
  // Of the normal: the two affine coordinates and the constant one.
  const Affine p_i = difference(0, 1, i), p_j = difference(0, 1, j), p_k = difference(0, 1, k);
  const Affine q_i = difference(0, 2, i), q_j = difference(0, 2, j), q_k = difference(0, 2, k);
  const auto minor = [](const Number& x, const Affine& y, const Number& z, const Affine& w) { // x y - z w
    return Affine{x * y.start - z * w.start, x * y.slope - z * w.slope};
  };
  Quadratic normal;
  normal.add_square(minor(p_j.start, q_k, q_j.start, p_k), one);
  normal.add_square(minor(q_i.start, p_k, p_i.start, q_k), one);
  normal.add_square({p_i.start * q_j.start - p_j.start * q_i.start, Number(0)}, one);
  const Number zero(0);
  CGAL::Uncertain<bool> is_kept = true;
  for (int from = 0; from < 3; ++from) {
    Quadratic side;
    for (int coordinate = 0; coordinate < 3; ++coordinate)
      side.add_square(difference(from, (from + 1) % 3, coordinate), one);
    const Quadratic q{normal.a - square * side.a, normal.b - square * side.b, normal.c - square * side.c};
    const auto is_low = CGAL::make_uncertain(q.c < zero);
    if (!CGAL::is_certain(is_low))
      return CGAL::Uncertain<bool>::indeterminate();
    if (CGAL::get_certain(is_low)) { // t (a t + b)
      const Number a = normal.a * side.c - normal.c * side.a, b = normal.b * side.c - normal.c * side.b;
      is_kept = is_kept & (CGAL::make_uncertain(b >= zero) & (a + b >= zero));
    } else
      is_kept = is_kept & (CGAL::make_uncertain(q.a + q.b + q.c >= zero) &
                           (CGAL::make_uncertain(q.a <= zero) | (q.b >= zero) | (2 * q.a + q.b <= zero) |
                            (q.b * q.b <= 4 * q.a * q.c)));
  }
  return is_kept;
}

/// Whether no altitude of a triangle is below min(delta, what it is at the start) at any time; by intervals, and where
/// these leave it open exactly.
inline bool is_delta_kept(const Axis_motion<3>& motion, double delta) {
  {
    CGAL::Protect_FPU_rounding<true> upward;
    const auto is_kept = is_delta_kept_in<CGAL::Interval_nt<false>>(motion, delta);
    if (CGAL::is_certain(is_kept))
      return CGAL::get_certain(is_kept);
  }
  return CGAL::get_certain(is_delta_kept_in<CGAL::Gmpq>(motion, delta));
}

} // namespace haptic_sculpt::internal
