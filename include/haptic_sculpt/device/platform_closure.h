// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/Device_pose.h>

/// \file
/// The general form in three unknowns: the link angles phi_i seen from the platform (paper section 2, restated).
///
/// Seen from the platform, elbow i is at (r + l2 cos phi_i) e_i + l2 sin phi_i k, so each pair of elbows has a distance
/// in the phi alone, and it must be the one the joint angles give. In units of l2, with a = 3 r / l2 and b = 3 r^2 /
/// l2^2 + 2: `f_ij = b + a (c_i + c_j) + c_i c_j - 2 s_i s_j - |B_i - B_j|^2 / l2^2 = 0`.

namespace haptic_sculpt {

/// Link angles by their cosines and sines, so that no step of an iteration needs a trigonometric function.
template <class S> struct Link_angles {
  using Scalar = S;        ///< of the cosines and sines
  Device_vector<S> cosine, ///< of each phi_i
      sine;                ///< of each phi_i; on the unit circle with its cosine

  /// Turns each angle by `step` to second order, staying on the unit circle.
  void turn(const Device_vector<S>& step) {
    for (int leg = 0; leg < 3; ++leg) {
      const S half = step[leg] / S(2), square = half * half, scale = S(1) / (S(1) + square);
      const S c = cosine[leg] * (S(1) - square) - sine[leg] * S(2) * half;
      sine[leg] = (sine[leg] * (S(1) - square) + cosine[leg] * S(2) * half) * scale;
      cosine[leg] = c * scale;
    }
  }
  /// Takes out what rounding has added to the length of (cosine, sine).
  void normalize() {
    for (int leg = 0; leg < 3; ++leg) {
      const S correction = (S(3) - cosine[leg] * cosine[leg] - sine[leg] * sine[leg]) / S(2);
      cosine[leg] *= correction;
      sine[leg] *= correction;
    }
  }
  /// The angles phi_i by arc tangents, rad.
  Device_vector<S> angles() const {
    using std::atan2;
    return {atan2(sine[0], cosine[0]), atan2(sine[1], cosine[1]), atan2(sine[2], cosine[2])};
  }
  /// \param phi the angles, rad
  static Link_angles from(const Device_vector<S>& phi) {
    using std::cos;
    using std::sin;
    Link_angles a;
    for (int leg = 0; leg < 3; ++leg)
      a.cosine[leg] = cos(phi[leg]), a.sine[leg] = sin(phi[leg]);
    return a;
  }
};

namespace internal {

/// The largest of three magnitudes.
template <class S> S largest_magnitude(const Device_vector<S>& v) {
  using std::abs;
  const S x = abs(v[0]), y = abs(v[1]), z = abs(v[2]);
  return x > y ? (x > z ? x : z) : (y > z ? y : z);
}

/// The largest difference of two triples of angles, each the short way round.
template <class S> S angular_distance(const Link_angles<S>& a, const Link_angles<S>& b) {
  using std::atan2;
  Device_vector<S> difference;
  for (int leg = 0; leg < 3; ++leg)
    difference[leg] = atan2(a.sine[leg] * b.cosine[leg] - a.cosine[leg] * b.sine[leg],
                            a.cosine[leg] * b.cosine[leg] + a.sine[leg] * b.sine[leg]);
  return largest_magnitude(difference);
}

/// Modes closer than this are one, rad. About a fold the closure, whose terms are of size one, grows with the square of
/// the way to it: rounded by the machine precision, its square root is what places either of two modes.
template <class S> S mode_separation() {
  using std::sqrt;
  const S place_of_a_mode = sqrt(std::numeric_limits<S>::epsilon()); // rad, to either side
  const S uncertain = S(2) * place_of_a_mode;                        // of two modes together
  return S(2) * uncertain;                                           // beyond it they are apart for certain
}

/// The three closure equations for given elbows. Equation k is that of the two legs other than k.
template <class S> struct Platform_closure {
  S linear, constant;                  ///< a, b
  Device_vector<S> separation_squared; ///< |B_i - B_j|^2 / l2^2 of the pair opposite leg k
  S rounding_of_elbows;                ///< epsilons that the rounding of the elbows makes of a separation_squared

  Platform_closure(const Device_parameters<S>& parameters, const Device_matrix<S>& elbows)
      : linear(parameters.closure_linear()), constant(parameters.closure_constant()) {
    const S& scale = parameters.inverse_secondary_length_squared();
    separation_squared[0] = (elbows.col(1) - elbows.col(2)).squaredNorm() * scale;
    separation_squared[1] = (elbows.col(2) - elbows.col(0)).squaredNorm() * scale;
    separation_squared[2] = (elbows.col(0) - elbows.col(1)).squaredNorm() * scale;
    // A coordinate of an elbow is off by some roundings of R + l1, five of epsilon at most for an elbow, and a square
    // by twice its root times that of two elbows.
    using std::sqrt;
    rounding_of_elbows = S(20) * sqrt(largest_magnitude(separation_squared)) *
                         (parameters.base_radius() + parameters.primary_length()) *
                         parameters.inverse_secondary_length();
  }

  template <class T>
  explicit Platform_closure(const Platform_closure<T>& other)
      : linear(other.linear)
      , constant(other.constant)
      , separation_squared(S(other.separation_squared[0]), S(other.separation_squared[1]),
                           S(other.separation_squared[2]))
      , rounding_of_elbows(S(other.rounding_of_elbows)) {}

  Device_vector<S> residual(const Link_angles<S>& x) const {
    Device_vector<S> f;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      f[k] = constant + linear * (x.cosine[i] + x.cosine[j]) + x.cosine[i] * x.cosine[j] -
             S(2) * x.sine[i] * x.sine[j] - separation_squared[k];
    }
    return f;
  }

  /// df_(pair of i, j) / dphi_i.
  S slope(const Link_angles<S>& x, int i, int j) const {
    return -x.sine[i] * (linear + x.cosine[j]) - S(2) * x.cosine[i] * x.sine[j];
  }

  /// Adjugate and determinant of the 3 by 3 derivative (row k: equation k, zero in column k).
  void derivative_adjugate(const Link_angles<S>& x, Device_matrix<S>& adjugate, S& determinant) const {
    const S a01 = slope(x, 0, 1), a10 = slope(x, 1, 0), a12 = slope(x, 1, 2), a21 = slope(x, 2, 1),
            a20 = slope(x, 2, 0), a02 = slope(x, 0, 2);
    adjugate << -a20 * a10, a21 * a10, a12 * a20, //
        a20 * a01, -a21 * a01, a21 * a02,         //
        a02 * a10, a12 * a01, -a12 * a02;
    determinant = a12 * a20 * a01 + a21 * a02 * a10;
  }

  Device_matrix<S> derivative(const Link_angles<S>& x) const {
    Device_matrix<S> g;
    g << S(0), slope(x, 1, 2), slope(x, 2, 1), slope(x, 0, 2), S(0), slope(x, 2, 0), slope(x, 0, 1), slope(x, 1, 0),
        S(0);
    return g;
  }

  /// Second derivative of the residual along v.
  Device_vector<S> curvature(const Link_angles<S>& x, const Device_vector<S>& v) const {
    Device_vector<S> f;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const S ci = x.cosine[i], cj = x.cosine[j], si = x.sine[i], sj = x.sine[j];
      f[k] = (-ci * (linear + cj) + S(2) * si * sj) * v[i] * v[i] +
             (-cj * (linear + ci) + S(2) * si * sj) * v[j] * v[j] + S(2) * (si * sj - S(2) * ci * cj) * v[i] * v[j];
    }
    return f;
  }

  /// A bound of the second derivative, as a map from steps to residuals in the largest-magnitude norm.
  S curvature_bound() const { return S(2) * linear + S(8); }
  /// What rounding can make of a residual, in units of l2^2: 16 roundings of the sum of its terms, for the five
  /// operations that make it, and what cosines and sines are off the unit circle; and the elbows'.
  S residual_rounding() const {
    const S terms = constant + S(2) * linear + S(3) + largest_magnitude(separation_squared),
            rounding_of_terms = S(16) * terms; // epsilons, as those of the elbows
    return std::numeric_limits<S>::epsilon() * (rounding_of_terms + rounding_of_elbows);
  }
};

/// How a Newton iteration ended.
enum class Newton_end { converged, not_certified, stalled };

/// Newton's method on the closure, started only if Kantorovich's theorem promises convergence to the one solution
/// nearby: |G^-1| L |first step| <= 1/2 with L the curvature bound, rounding of the step counted.
/// \param strayed how far the separations stray from the straight line between those of the start and the closure's on
/// the way between. With it the theorem holds all along the way, so that the solution found is the continuation of the
/// start, never that of another assembly mode.
template <class S>
inline Newton_end certified_newton(const Platform_closure<S>& closure, Link_angles<S>& x, const S& strayed = S(0)) {
  using std::abs;
  const S bound = closure.curvature_bound();
  const S epsilon = std::numeric_limits<S>::epsilon();
  Device_matrix<S> adjugate;
  S determinant, previous(0);
  for (int iteration = 0; iteration < 40; ++iteration) {
    closure.derivative_adjugate(x, adjugate, determinant);
    const S inverse_determinant = S(1) / determinant;
    const Device_vector<S> step = -(adjugate * closure.residual(x)) * inverse_determinant;
    const S length = largest_magnitude(step);
    S inverse_norm = S(0); // of G^-1, largest absolute row sum
    for (int row = 0; row < 3; ++row) {
      const S sum = abs(adjugate(row, 0)) + abs(adjugate(row, 1)) + abs(adjugate(row, 2));
      inverse_norm = sum > inverse_norm ? sum : inverse_norm;
    }
    inverse_norm *= abs(inverse_determinant);
    const S contraction = inverse_norm * bound * length;
    if (iteration == 0 &&
        !(contraction + inverse_norm * bound * inverse_norm * (strayed + closure.residual_rounding()) <= S(0.5)))
      return Newton_end::not_certified;
    x.turn(step);
    // The next error is at most contraction times this step.
    if (contraction * length <= epsilon / S(8))
      return Newton_end::converged;
    // Near a singular pose rounding puts a floor under the steps: stop when they no longer shrink.
    if (iteration > 0 && !(length < previous / S(2)))
      return length * length <= epsilon ? Newton_end::converged : Newton_end::stalled;
    previous = length;
  }
  return Newton_end::stalled;
}

/// Newton's method without a promise: steps are cut to half a radian. False if it does not settle.
template <class S> inline bool free_newton(const Platform_closure<S>& closure, Link_angles<S>& x, int most_iterations) {
  const S epsilon = std::numeric_limits<S>::epsilon();
  Device_matrix<S> adjugate;
  S determinant, previous(0);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    closure.derivative_adjugate(x, adjugate, determinant);
    if (determinant == S(0))
      return false;
    Device_vector<S> step = -(adjugate * closure.residual(x)) / determinant;
    S length = largest_magnitude(step);
    if (!(length * S(0) == S(0)))
      return false;
    if (length > S(0.5)) {
      step *= S(0.5) / length;
      length = S(0.5);
    }
    x.turn(step);
    if (length <= S(4) * epsilon ||
        (length * length * length <= epsilon && iteration > 0 && !(length < previous / S(2)))) {
      x.normalize();
      return largest_magnitude(closure.residual(x)) <= S(64) * epsilon * (closure.constant + closure.linear + S(3));
    }
    previous = length;
  }
  return false;
}

} // namespace internal
} // namespace haptic_sculpt
