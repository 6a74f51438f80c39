// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace haptic_sculpt::internal {

/// The LU factors of a small square matrix, rows pivoted: the operations of Eigen's PartialPivLU one by one, so that
/// the bits are its bits, but on scalars. Eigen's expressions for them compile for two seconds a size and number type.
template <class S, int size>
class Small_lu {
public:
  using Matrix = Eigen::Matrix<S, size, size>;
  using Vector = Eigen::Matrix<S, size, 1>;

  EIGEN_DONT_INLINE void compute(const Matrix& matrix) {
    using std::abs;
    lu_ = matrix;
    for (int k = 0; k < size; ++k) {
      int pivot = k;
      S largest = abs(lu_(k, k));
      for (int row = k + 1; row < size; ++row) {
        const S magnitude = abs(lu_(row, k));
        if (magnitude > largest)
          largest = magnitude, pivot = row;
      }
      pivots_[k] = pivot;
      if (largest == S(0))
        continue;
      if (pivot != k)
        for (int column = 0; column < size; ++column) {
          const S kept = lu_(k, column);
          lu_(k, column) = lu_(pivot, column);
          lu_(pivot, column) = kept;
        }
      for (int row = k + 1; row < size; ++row)
        lu_(row, k) /= lu_(k, k);
      for (int column = k + 1; column < size; ++column)
        for (int row = k + 1; row < size; ++row)
          lu_(row, column) -= lu_(row, k) * lu_(k, column);
    }
  }

  /// The least magnitude of a pivot: 0 for a singular matrix.
  S least_pivot() const {
    using std::abs;
    S least = abs(lu_(0, 0));
    for (int k = 1; k < size; ++k) {
      const S pivot = abs(lu_(k, k));
      least = pivot < least ? pivot : least;
    }
    return least;
  }

  /// The solution for one right-hand side; not finite for a singular matrix.
  EIGEN_DONT_INLINE Vector solve(const Vector& right) const {
    Vector x = right;
    for (int k = 0; k < size; ++k) {
      const S kept = x[k];
      x[k] = x[pivots_[k]];
      x[pivots_[k]] = kept;
    }
    forward<1>(x);
    backward<size - 1>(x);
    return x;
  }

private:
  template <int row>
  void forward(Vector& x) const {
    if constexpr (row < size) {
      x[row] -= products<row>(row, 0, x);
      forward<row + 1>(x);
    }
  }
  template <int row>
  void backward(Vector& x) const {
    if constexpr (row >= 0) {
      if constexpr (row < size - 1)
        x[row] -= products<size - 1 - row>(row, row + 1, x);
      x[row] /= lu_(row, row);
      backward<row - 1>(x);
    }
  }
  /// The sum of `count` products of row entries and unknowns, from column `first` on, halved like Eigen's unrolled
  /// sums.
  template <int count>
  S products(int row, int first, const Vector& x) const {
    if constexpr (count == 1)
      return lu_(row, first) * x[first];
    else
      return products<count / 2>(row, first, x) + products<count - count / 2>(row, first + count / 2, x);
  }

  Matrix lu_;
  int pivots_[size];
};

} // namespace haptic_sculpt::internal
