// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/Device_pose.h>

/// \file
/// Closed-form kinematics of the di-tetrahedral form (paper section 2, Fig. 2): the apex is at distance l2 from three
/// elbows.

namespace haptic_sculpt {
namespace internal {

/// The next wider built-in number, to recompute what cancellation has eaten; user-defined scalars stay themselves.
template <class S> struct Wider { using type = S; };
template <> struct Wider<float> { using type = double; };
template <> struct Wider<double> { using type = long double; };

/// -0 becomes 0, whatever the rounding mode, so that a level point behind the shoulder is at +pi. Derivatives of
/// Eigen's AutoDiffScalar stay.
template <class S>
S without_sign_of_zero(const S& x) {
  using std::abs;
  return x == S(0) ? S(abs(x)) : x;
}

/// Below this part of l2^2 the squared height of the apex over the elbow plane has lost two digits to cancellation.
template <class S> S cancelled_height() { return S(1) / S(100); }

/// The two points at a length l from three elbows. With n = a x b the normal of the elbow triangle (sides a, b, c), the
/// circumcentre is at
/// ((|a|^2 b - |b|^2 a) x n) / (2 |n|^2) and the apex sqrt(l^2 |n|^2 - |a|^2 |b|^2 |c|^2 / 4) / |n|^2 n from it: one
/// root, one division.
template <class S> struct Apex_pair {
  Device_vector<S> to_centre, normal; ///< to_centre times |n|^2; n
  S normal_squared;                   ///< |n|^2
  S height_squared,
      full_height; ///< (l^2 - circumradius^2) |n|^2, negative where no apex exists, and l^2 |n|^2 to compare it with
  bool collinear;

  /// From the first elbow to the apex. \pre height_squared >= 0
  Device_vector<S> apex(int mode) const {
    using std::sqrt;
    return (to_centre + (S(mode) * sqrt(height_squared)) * normal) * (S(1) / normal_squared);
  }
};

template <class S>
inline void apex_pair(const Device_matrix<S>& elbows, const S& length, const S& size, Apex_pair<S>& pair) {
  const Device_vector<S> a = elbows.col(1) - elbows.col(0), b = elbows.col(2) - elbows.col(0);
  pair.normal = a.cross(b);
  const S aa = a.squaredNorm(), bb = b.squaredNorm(), cc = (b - a).squaredNorm();
  pair.normal_squared = pair.normal.squaredNorm();
  pair.collinear = !spans_a_plane(pair.normal_squared, aa, bb, size);
  pair.to_centre = (S(0.5) * (aa * b - bb * a)).cross(pair.normal);
  pair.full_height = length * length * pair.normal_squared;
  pair.height_squared = pair.full_height - S(0.25) * aa * bb * cc;
}

/// The same from the angles, in wider arithmetic; returns the first elbow.
template <class W, class S>
inline Device_vector<W> apex_pair_widened(const Device_parameters<S>& parameters, const Device_vector<S>& theta,
                                          Apex_pair<W>& pair) {
  using std::cos;
  using std::sin;
  Device_matrix<W> elbows;
  for (int leg = 0; leg < 3; ++leg)
    elbows.col(leg) = Leg_frame<W>::in_leg_plane(
        leg, W(parameters.base_radius()) + W(parameters.primary_length()) * cos(W(theta[leg])),
        W(parameters.primary_length()) * sin(W(theta[leg])));
  apex_pair(elbows, W(parameters.secondary_length()), W(W(parameters.base_radius()) + W(parameters.primary_length())),
            pair);
  return elbows.col(0);
}

} // namespace internal

/// The apex for given joint angles, in closed form.
///
/// `mode` +1 takes the apex on the side of the elbow plane its normal (B_1 - B_0) x (B_2 - B_0) points to, which is up
/// in ordinary poses, -1 the mirror image. Error of the apex: a few roundings times l2 / h, h the height over the elbow
/// plane; where h is small, wider arithmetic (float to double, double to long double) takes the cancellation. Failures:
/// `unreachable`, shortfall circumradius / l2 - 1; `singular`: elbows on a line or coincident; `not_finite`.
/// \pre `parameters.form() == Device_form::ditetrahedral`, mode is 1 or -1
template <class S>
inline Outcome<Device_pose<S>> ditetrahedral_forward(const Device_parameters<S>& parameters,
                                                     const Device_vector<S>& theta, int mode) {
  Outcome<Device_pose<S>> outcome;
  Device_pose<S>& pose = outcome.value_to_fill();
  if (!internal::place_elbows(parameters, theta, pose)) {
    outcome.fail(Device_status::not_finite, S(0));
    return outcome;
  }
  pose.mode = mode;
  internal::Apex_pair<S> pair;
  internal::apex_pair(pose.elbows, parameters.secondary_length(),
                      S(parameters.base_radius() + parameters.primary_length()), pair);
  if (!pair.collinear && pair.height_squared > internal::cancelled_height<S>() * pair.full_height) {
    pose.position = pose.elbows.col(0) + pair.apex(mode);
  } else {
    using std::sqrt;
    using W = typename internal::Wider<S>::type;
    internal::Apex_pair<W> wide;
    const Device_vector<W> first = internal::apex_pair_widened<W, S>(parameters, theta, wide);
    if (pair.collinear || wide.collinear) {
      outcome.fail(Device_status::singular, S(0));
      return outcome;
    }
    if (wide.height_squared < W(0)) {
      const W excess = sqrt(W(1) - wide.height_squared / wide.full_height) - W(1);
      outcome.fail(Device_status::unreachable, S(excess));
      return outcome;
    }
    const Device_vector<W> apex = first + wide.apex(mode);
    for (int axis = 0; axis < 3; ++axis)
      pose.position[axis] = S(apex[axis]);
  }
  for (int leg = 0; leg < 3; ++leg) {
    pose.joints.col(leg) = pose.position;
    pose.links.col(leg) = (pose.position - pose.elbows.col(leg)) * parameters.inverse_secondary_length();
  }
  pose.orientation.setIdentity();
  if (internal::all_finite(pose.position))
    outcome.succeed();
  else
    outcome.fail(Device_status::not_finite, S(0));
  return outcome;
}

/// The two joint angles of each leg that bring the apex to a point.
template <class S> struct Ditetrahedral_inverse {
  using Scalar = S;                  ///< what `Outcome` measures a shortfall in
  Device_vector<S> minus; ///< angle towards the point less the half-opening, rad; knee bent one way (working mode 0)
  Device_vector<S> plus;  ///< plus the half-opening (working mode 1); not reduced to one turn, so minus <= plus
  Device_vector<S> one_minus_cosine; ///< 1 - |cos half-opening|: negative by how far the leg misses the point, 0 at a
                                     ///< straight or folded knee
  bool leg_reaches[3];               ///< legs that do not reach have no angles: their `minus` and `plus` are 0
};

namespace internal {

/// The triangle shoulder, elbow, point in the leg plane: (1 - c) and (1 + c) of the half-opening's cosine c, each
/// without cancellation.
template <class S> struct Leg_triangle {
  S x, z, distance, one_minus, one_plus;
};

/// Of 1 less or more a leg's cosine, without unit: what the few operations that it comes from may round off. A leg that
/// is straight or folded but for this is straight or folded.
template <class S>
S rounding_of_leg() {
  return S(4) * std::numeric_limits<S>::epsilon();
}

template <class S>
inline Leg_triangle<S> leg_triangle(const Device_parameters<S>& parameters, const Device_vector<S>& point, int leg) {
  using std::sqrt;
  Leg_triangle<S> t;
  t.x = Leg_frame<S>::along_radial(leg, point) - parameters.base_radius();
  t.z = point[2];
  const S across = Leg_frame<S>::along_tangential(leg, point);
  const S& l1 = parameters.primary_length();
  const S& l2 = parameters.secondary_length();
  t.distance = sqrt(t.x * t.x + t.z * t.z);
  const S in_plane_squared =
      (l2 - across) * (l2 + across); // square of the secondary link's projection on the leg plane
  const S scale = S(1) / (S(2) * l1 * t.distance);
  t.one_minus = (in_plane_squared - (t.distance - l1) * (t.distance - l1)) * scale;
  t.one_plus = ((t.distance + l1) * (t.distance + l1) - in_plane_squared) * scale;
  const S rounding = rounding_of_leg<S>();
  if (t.one_minus > -rounding && t.one_minus < S(0))
    t.one_minus = S(0);
  if (t.one_plus > -rounding && t.one_plus < S(0))
    t.one_plus = S(0);
  return t;
}

} // namespace internal

/// All solutions of the inverse kinematics: two angles a leg, eight in combination.
///
/// Failures: `not_finite`; `singular`: the point lies on a leg's shoulder (any angle would do or none);
/// `unreachable`: shortfall is the largest |cosine| - 1 of a leg. On `unreachable` the value is nevertheless filled in
/// leg by leg, so that a caller can see which legs miss.
template <class S>
inline Outcome<Ditetrahedral_inverse<S>> ditetrahedral_inverse(const Device_parameters<S>& parameters,
                                                               const Device_vector<S>& point) {
  using std::atan2;
  using std::sqrt;
  Outcome<Ditetrahedral_inverse<S>> outcome;
  Ditetrahedral_inverse<S> inverse;
  S shortfall(-1);
  for (int leg = 0; leg < 3; ++leg) {
    const auto t = internal::leg_triangle(parameters, point, leg);
    if (!internal::is_finite(t.one_minus) || !internal::is_finite(t.one_plus)) {
      outcome.fail(t.distance == S(0) ? Device_status::singular : Device_status::not_finite, S(0));
      return outcome;
    }
    const S least = t.one_minus < t.one_plus ? t.one_minus : t.one_plus;
    inverse.one_minus_cosine[leg] = least;
    inverse.leg_reaches[leg] = least >= S(0);
    if (!inverse.leg_reaches[leg]) {
      inverse.minus[leg] = inverse.plus[leg] = S(0);
      if (-least > shortfall)
        shortfall = -least;
      continue;
    }
    const S centre = atan2(internal::without_sign_of_zero(t.z), t.x);
    const S half_opening = S(2) * atan2(S(sqrt(t.one_minus)), S(sqrt(t.one_plus)));
    inverse.minus[leg] = centre - half_opening;
    inverse.plus[leg] = centre + half_opening;
  }
  if (shortfall >= S(0))
    outcome.fail(Device_status::unreachable, shortfall);
  else
    outcome.succeed();
  outcome.value_to_fill() = inverse;
  return outcome;
}

/// A triple of joint angles.
template <class S> struct Joint_angles {
  using Scalar = S;       ///< what `Outcome` measures a shortfall in
  Device_vector<S> theta; ///< rad, in (-pi, pi]
};

/// One solution of the inverse kinematics, that of the given working mode (0: minus, 1: plus, for each leg): one arc
/// tangent a leg.
///
/// Failures as for all solutions.
template <class S>
inline Outcome<Joint_angles<S>> ditetrahedral_inverse(const Device_parameters<S>& parameters,
                                                      const Device_vector<S>& point,
                                                      const Eigen::Vector3i& working_mode) {
  using std::atan2;
  using std::sqrt;
  Outcome<Joint_angles<S>> outcome;
  Joint_angles<S>& angles = outcome.value_to_fill();
  S shortfall(-1);
  bool finite = true, at_shoulder = false;
  for (int leg = 0; leg < 3; ++leg) {
    const auto t = internal::leg_triangle(parameters, point, leg);
    const S least = t.one_minus < t.one_plus ? t.one_minus : t.one_plus;
    finite = finite && internal::is_finite(t.one_minus) && internal::is_finite(t.one_plus);
    at_shoulder = at_shoulder || t.distance == S(0);
    if (!(least >= S(0))) {
      if (-least > shortfall)
        shortfall = -least;
      continue;
    }
    const S cosine = (t.one_plus - t.one_minus) / S(2);
    const S sine = working_mode[leg] == 0 ? S(-sqrt(t.one_minus * t.one_plus)) : S(sqrt(t.one_minus * t.one_plus));
    angles.theta[leg] =
        atan2(internal::without_sign_of_zero(S(t.z * cosine + t.x * sine)), S(t.x * cosine - t.z * sine));
  }
  if (!finite)
    outcome.fail(at_shoulder ? Device_status::singular : Device_status::not_finite, S(0));
  else if (shortfall >= S(0))
    outcome.fail(Device_status::unreachable, shortfall);
  else
    outcome.succeed();
  return outcome;
}

/// The working mode (0 or 1 for each leg) a pose is in: on which side of the shoulder-joint line each knee is.
template <class S>
inline Eigen::Vector3i working_mode(const Device_parameters<S>& parameters, const Device_pose<S>& pose) {
  Eigen::Vector3i mode;
  for (int leg = 0; leg < 3; ++leg)
    mode[leg] = pose.links.col(leg).dot(pose.elbow_rate(parameters, leg)) >= S(0) ? 0 : 1;
  return mode;
}

/// The side of the elbow plane a point is on, as the `mode` of `ditetrahedral_forward`.
template <class S>
inline int ditetrahedral_mode(const Device_parameters<S>& parameters, const Device_vector<S>& theta,
                              const Device_vector<S>& point) {
  Device_pose<S> pose;
  internal::place_elbows(parameters, theta, pose);
  const Device_vector<S> a = pose.elbows.col(1) - pose.elbows.col(0), b = pose.elbows.col(2) - pose.elbows.col(0);
  return a.cross(b).dot(point - pose.elbows.col(0)) >= S(0) ? 1 : -1;
}

} // namespace haptic_sculpt
