// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/no_fast_math.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <type_traits>

namespace haptic_sculpt {

/// A 3-vector of the device's scalar; as a world vector in metres, z up.
template <class S> using Device_vector = Eigen::Matrix<S, 3, 1>;
/// A 3 by 3 matrix; where it holds one vector per leg, column i belongs to leg i.
template <class S> using Device_matrix = Eigen::Matrix<S, 3, 3>;

/// The two values of the cosine and sine of 120 degrees that every leg frame is made of.
template <class S> S half_sqrt_three() {
  if constexpr (std::is_floating_point<S>::value)
    return S(0.866025403784438646763723170752936183471402627L);
  else
    return sqrt(S(3)) / S(2);
}

/// The frame of leg i (0, 1, 2 at 0, 120 and 240 degrees): `radial` e_i points outward, `tangential` t_i
/// counterclockwise, and the third axis is k, up. Constant, and written out so that the compiler folds it.
template <class S> struct Leg_frame {
  /// e_i, of length 1, world axes. \pre leg is 0, 1 or 2, here and below
  static Device_vector<S> radial(int leg) {
    const S h = half_sqrt_three<S>();
    return leg == 0   ? Device_vector<S>(S(1), S(0), S(0))
           : leg == 1 ? Device_vector<S>(S(-0.5), h, S(0))
                      : Device_vector<S>(S(-0.5), -h, S(0));
  }
  /// t_i = k x e_i, of length 1, world axes.
  static Device_vector<S> tangential(int leg) {
    const S h = half_sqrt_three<S>();
    return leg == 0   ? Device_vector<S>(S(0), S(1), S(0))
           : leg == 1 ? Device_vector<S>(-h, S(-0.5), S(0))
                      : Device_vector<S>(h, S(-0.5), S(0));
  }
  /// e_i.v without building e_i.
  template <class V> static S along_radial(int leg, const V& v) {
    const S h = half_sqrt_three<S>();
    return leg == 0 ? S(v[0]) : leg == 1 ? S(-v[0] / S(2) + h * v[1]) : S(-v[0] / S(2) - h * v[1]);
  }
  /// t_i.v without building t_i.
  template <class V> static S along_tangential(int leg, const V& v) {
    const S h = half_sqrt_three<S>();
    return leg == 0 ? S(v[1]) : leg == 1 ? S(-h * v[0] - v[1] / S(2)) : S(h * v[0] - v[1] / S(2));
  }
  /// The vector `x e_i + z k`.
  static Device_vector<S> in_leg_plane(int leg, const S& x, const S& z) {
    const S h = half_sqrt_three<S>();
    return leg == 0   ? Device_vector<S>(x, S(0), z)
           : leg == 1 ? Device_vector<S>(-x / S(2), h * x, z)
                      : Device_vector<S>(-x / S(2), -h * x, z);
  }
};

namespace internal {

/// True where every entry is a number: neither infinite nor not-a-number.
template <class V> bool all_finite(const Eigen::MatrixBase<V>& values) {
  using S = typename V::Scalar;
  S sum(0);
  for (Eigen::Index column = 0; column < values.cols(); ++column)
    for (Eigen::Index row = 0; row < values.rows(); ++row)
      sum += values(row, column) * S(0); // 0 unless an entry is infinite or not a number
  return sum == S(0);
}

template <class S> bool is_finite(const S& value) { return value * S(0) == S(0); }

/// The 3 by 3 inverse by cross products, times the determinant, and that determinant.
template <class S> void adjugate(const Device_matrix<S>& a, Device_matrix<S>& adjugate, S& determinant) {
  adjugate.row(0) = a.col(1).cross(a.col(2)).transpose();
  adjugate.row(1) = a.col(2).cross(a.col(0)).transpose();
  adjugate.row(2) = a.col(0).cross(a.col(1)).transpose();
  determinant = adjugate.row(0).dot(a.col(0).transpose());
}

} // namespace internal
} // namespace haptic_sculpt
