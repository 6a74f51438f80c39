// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

/// \file
/// Singular values of a small square matrix, by two-sided Jacobi rotations.
///
/// The operations are those of Eigen's JacobiSVD one by one, so that the bits are its bits, but on scalars:
/// Eigen's take an eighth more time for three by three, once a tick of a loop, and ask for `isfinite` of a scalar
/// (doc/results/compiling.md).

namespace haptic_sculpt::internal {

/// A plane rotation: x becomes c x + s y, and y becomes c y - s x.
template <class S>
struct Plane_rotation {
  S c, s;

  Plane_rotation transposed() const { return {c, S(-s)}; }
  /// This one after the other.
  Plane_rotation times(const Plane_rotation& other) const {
    return {S(c * other.c - s * other.s), S(c * other.s + s * other.c)};
  }
  void turn(S& x, S& y) const {
    const S before = x;
    x = c * before + s * y;
    y = -s * before + c * y;
  }
  /// The one that makes the symmetric matrix (x y; y z) diagonal.
  static Plane_rotation diagonalizing(const S& x, const S& y, const S& z) {
    using std::abs;
    using std::sqrt;
    const S twice = S(2) * abs(y);
    if (twice < std::numeric_limits<S>::min())
      return {S(1), S(0)};
    const S tau = (x - z) / twice, w = sqrt(tau * tau + S(1));
    const S t = tau > S(0) ? S(S(1) / (tau + w)) : S(S(1) / (tau - w));
    const S n = S(1) / sqrt(t * t + S(1));
    const S sign = t > S(0) ? S(1) : S(-1);
    return {n, S(-sign * (y / abs(y)) * abs(t) * n)};
  }
};

/// The singular values, the greatest first. Infinite or not-a-number entries make all of them not a number.
template <class S, int size>
Eigen::Matrix<S, size, 1> singular_values(const Eigen::Matrix<S, size, size>& matrix) {
  using std::abs;
  using std::sqrt;
  using Rotation = Plane_rotation<S>;
  Eigen::Matrix<S, size, 1> values;
  S scale(0), finite(0);
  for (int column = 0; column < size; ++column)
    for (int row = 0; row < size; ++row) {
      const S magnitude = abs(matrix(row, column));
      scale = magnitude > scale ? magnitude : scale;
      finite += magnitude * S(0);
    }
  if (!(finite == S(0))) {
    for (int i = 0; i < size; ++i)
      values[i] = std::numeric_limits<S>::quiet_NaN();
    return values;
  }
  if (scale == S(0))
    scale = S(1);
  Eigen::Matrix<S, size, size> w;
  S largest(0); // of the diagonal so far
  for (int column = 0; column < size; ++column)
    for (int row = 0; row < size; ++row)
      w(row, column) = matrix(row, column) / scale;
  for (int i = 0; i < size; ++i)
    largest = abs(w(i, i)) > largest ? S(abs(w(i, i))) : largest;
  for (bool finished = false; !finished;) {
    finished = true;
    for (int p = 1; p < size; ++p)
      for (int q = 0; q < p; ++q) {
        const S rounding = S(2) * std::numeric_limits<S>::epsilon() * largest;
        const S negligible = rounding > std::numeric_limits<S>::min() ? rounding : std::numeric_limits<S>::min();
        if (!(abs(w(p, q)) > negligible || abs(w(q, p)) > negligible))
          continue;
        finished = false;
        // One rotation makes the 2 by 2 block symmetric, a second one diagonal.
        S a = w(p, p), b = w(p, q), c = w(q, p), d = w(q, q);
        const S trace = a + d, skew = c - b;
        Rotation symmetric{S(1), S(0)};
        if (!(abs(skew) < std::numeric_limits<S>::min())) {
          const S u = trace / skew, length = sqrt(S(1) + u * u);
          symmetric = {S(u / length), S(S(1) / length)};
        }
        symmetric.turn(a, c);
        symmetric.turn(b, d);
        const Rotation right = Rotation::diagonalizing(a, b, d), left = symmetric.times(right.transposed());
        for (int column = 0; column < size; ++column)
          left.turn(w(p, column), w(q, column));
        for (int row = 0; row < size; ++row)
          right.transposed().turn(w(row, p), w(row, q));
        for (int i : {p, q})
          largest = abs(w(i, i)) > largest ? S(abs(w(i, i))) : largest;
      }
  }
  for (int i = 0; i < size; ++i)
    values[i] = abs(w(i, i)) * scale;
  for (int i = 0; i < size; ++i)
    for (int k = i + 1; k < size; ++k)
      if (values[k] > values[i]) {
        const S kept = values[i];
        values[i] = values[k];
        values[k] = kept;
      }
  return values;
}

} // namespace haptic_sculpt::internal
