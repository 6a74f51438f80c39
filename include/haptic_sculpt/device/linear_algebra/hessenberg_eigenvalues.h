// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>

/// \file
/// Eigenvalues of a small upper Hessenberg matrix, by Francis' double-shift QR iteration (EISPACK's hqr).
///
/// The operations are those of Eigen's EigenSolver one by one, but on scalars and on the active window only: every
/// program that asks for a pose contains them, and Eigen's solver compiles for 12 seconds for one size of matrix and
/// one number type.

namespace haptic_sculpt::internal {

template <class S, int size>
class Hessenberg_eigenvalues {
public:
  using Matrix = Eigen::Matrix<S, size, size>;
  std::array<S, size> real, imaginary; ///< complex ones stand side by side, that with the positive imaginary part first

  /// False if the iteration does not settle. `matrix` must be zero below its subdiagonal.
  bool compute(const Matrix& matrix) {
    using std::abs;
    scale_ = S(0);
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column)
        scale_ = abs(matrix(row, column)) > scale_ ? S(abs(matrix(row, column))) : scale_;
    real.fill(S(0)), imaginary.fill(S(0));
    if (scale_ < std::numeric_limits<S>::min())
      return true;
    S norm(0);
    for (int column = 0; column < size; ++column)
      for (int row = 0; row < size; ++row) {
        t_(row, column) = matrix(row, column) / scale_;
        norm += abs(t_(row, column));
      }
    const S tiny = norm * (std::numeric_limits<S>::epsilon() * std::numeric_limits<S>::epsilon());
    least_ = tiny > std::numeric_limits<S>::min() ? tiny : std::numeric_limits<S>::min();
    shifted_ = S(0);
    int last = size - 1, tries = 0, steps = 0; // of the active window
    while (last >= 0) {
      const int first = window_begin(last);
      if (first == last) {
        real[last] = (t_(last, last) + shifted_) * scale_;
        --last, tries = 0;
      } else if (first == last - 1) {
        split_pair(first);
        last -= 2, tries = 0;
      } else {
        choose_shift(last, tries++);
        if (++steps > 40 * size)
          return false;
        qr_step(first, last);
      }
    }
    return true;
  }

private:
  /// The row of the lowest negligible subdiagonal entry.
  int window_begin(int last) const {
    using std::abs;
    int row = last;
    for (; row > 0; --row) {
      const S neighbours = (abs(t_(row - 1, row - 1)) + abs(t_(row, row))) * std::numeric_limits<S>::epsilon();
      if (abs(t_(row, row - 1)) <= (neighbours > least_ ? neighbours : least_))
        break;
    }
    return row;
  }

  /// The two eigenvalues of the 2 by 2 block that begins at row i.
  void split_pair(int i) {
    using std::abs;
    using std::sqrt;
    const int j = i + 1;
    const S half_difference = S(0.5) * (t_(i, i) - t_(j, j)), lower = t_(j, i), upper = t_(i, j);
    const S discriminant = half_difference * half_difference + lower * upper;
    const S a = t_(i, i) + shifted_, d = t_(j, j) + shifted_;
    if (discriminant >= S(0)) { // a rotation makes the block triangular
      const S root = sqrt(abs(discriminant)),
              x = half_difference >= S(0) ? S(half_difference + root) : S(half_difference - root);
      S c(1), s(0);
      givens(x, lower, c, s);
      // R^T (a upper; lower d) R
      const S aa = c * a - s * lower, bb = c * upper - s * d, cc = s * a + c * lower, dd = s * upper + c * d;
      real[i] = (c * aa - s * bb) * scale_;
      real[j] = (s * cc + c * dd) * scale_;
    } else {
      const S sa = a * scale_, sd = d * scale_, p = S(0.5) * (sa - sd);
      S low = lower * scale_, up = upper * scale_, largest = abs(p);
      largest = abs(low) > largest ? S(abs(low)) : largest;
      largest = abs(up) > largest ? S(abs(up)) : largest;
      low /= largest, up /= largest;
      const S part = p / largest;
      real[i] = real[j] = sd + p;
      imaginary[i] = largest * sqrt(abs(part * part + low * up));
      imaginary[j] = -imaginary[i];
    }
  }

  /// (c, s) with s p + c q = 0.
  static void givens(const S& p, const S& q, S& c, S& s) {
    using std::abs;
    using std::sqrt;
    if (q == S(0)) {
      c = p < S(0) ? S(-1) : S(1), s = S(0);
    } else if (p == S(0)) {
      c = S(0), s = q < S(0) ? S(1) : S(-1);
    } else if (abs(p) > abs(q)) {
      const S t = q / p, u = p < S(0) ? S(-sqrt(S(1) + t * t)) : S(sqrt(S(1) + t * t));
      c = S(1) / u, s = -t * c;
    } else {
      const S t = p / q, u = q < S(0) ? S(-sqrt(S(1) + t * t)) : S(sqrt(S(1) + t * t));
      s = S(-1) / u, c = -t * s;
    }
  }

  /// The two shifts, as the lower right 2 by 2 block has them; ad hoc ones where the iteration has not settled after 10
  /// and 30 steps.
  void choose_shift(int last, int tries) {
    using std::abs;
    using std::sqrt;
    shift_[0] = t_(last, last), shift_[1] = t_(last - 1, last - 1), shift_[2] = t_(last, last - 1) * t_(last - 1, last);
    if (tries == 10) {
      move_diagonal(last, shift_[0]);
      const S s = abs(t_(last, last - 1)) + abs(t_(last - 1, last - 2));
      shift_[0] = shift_[1] = S(0.75) * s;
      shift_[2] = S(-0.4375) * s * s;
    }
    if (tries == 30) {
      S s = (shift_[1] - shift_[0]) / S(2);
      s = s * s + shift_[2];
      if (s > S(0)) {
        s = sqrt(s);
        if (shift_[1] < shift_[0])
          s = -s;
        s = s + (shift_[1] - shift_[0]) / S(2);
        move_diagonal(last, S(shift_[0] - shift_[2] / s));
        shift_.fill(S(0.964));
      }
    }
  }
  void move_diagonal(int last, const S& by) {
    shifted_ += by;
    for (int i = 0; i <= last; ++i)
      t_(i, i) -= by;
  }

  /// One implicit double step on the window: a bulge is made at row `start` and chased out below.
  void qr_step(int first, int last) {
    using std::abs;
    std::array<S, 3> v{S(0), S(0), S(0)};
    int start = last - 2;
    for (;; --start) {
      const S here = t_(start, start), r = shift_[0] - here, s = shift_[1] - here;
      v[0] = (r * s - shift_[2]) / t_(start + 1, start) + t_(start, start + 1);
      v[1] = t_(start + 1, start + 1) - here - r - s;
      v[2] = t_(start + 2, start + 1);
      if (start == first)
        break;
      const S left = t_(start, start - 1) * (abs(v[1]) + abs(v[2]));
      const S right = v[0] * (abs(t_(start - 1, start - 1)) + abs(here) + abs(t_(start + 1, start + 1)));
      if (abs(left) < std::numeric_limits<S>::epsilon() * right)
        break;
    }
    for (int k = start; k <= last - 1; ++k) {
      const int count = k == last - 1 ? 2 : 3;
      if (k > start)
        for (int i = 0; i < count; ++i)
          v[i] = t_(k + i, k - 1);
      reflect(v, count, k, k == start, first, last);
    }
    for (int i = start + 2; i <= last; ++i) {
      t_(i, i - 2) = S(0);
      if (i > start + 2)
        t_(i, i - 3) = S(0);
    }
  }

  /// Applies the Householder reflection that turns v (`count` entries) into a multiple of (1, 0, ..), from both sides,
  /// at row and column k.
  void reflect(const std::array<S, 3>& v, int count, int k, bool begins, int first, int last) {
    using std::sqrt;
    S tail(0);
    for (int i = 1; i < count; ++i)
      tail += v[i] * v[i];
    S tau(0), beta = v[0], e[3] = {S(1), S(0), S(0)};
    if (!(tail <= std::numeric_limits<S>::min())) {
      beta = sqrt(v[0] * v[0] + tail);
      if (v[0] >= S(0))
        beta = -beta;
      for (int i = 1; i < count; ++i)
        e[i] = v[i] / (v[0] - beta);
      tau = (beta - v[0]) / beta;
    }
    if (beta == S(0))
      return;
    if (!begins)
      t_(k, k - 1) = beta;
    else if (k > first)
      t_(k, k - 1) = -t_(k, k - 1);
    if (tau == S(0))
      return;
    for (int column = k; column <= last; ++column) {
      S sum = t_(k + 1, column) * e[1];
      if (count == 3)
        sum += t_(k + 2, column) * e[2];
      sum += t_(k, column);
      t_(k, column) -= tau * sum;
      for (int i = 1; i < count; ++i)
        t_(k + i, column) -= (tau * e[i]) * sum;
    }
    const int bottom = k + 3 < last ? k + 3 : last;
    for (int row = first; row <= bottom; ++row) {
      S sum = t_(row, k + 1) * e[1];
      if (count == 3)
        sum += t_(row, k + 2) * e[2];
      sum += t_(row, k);
      t_(row, k) -= tau * sum;
      for (int i = 1; i < count; ++i)
        t_(row, k + i) -= (tau * sum) * e[i];
    }
  }

  Matrix t_;
  std::array<S, 3> shift_;
  S scale_, least_, shifted_;
};

} // namespace haptic_sculpt::internal
