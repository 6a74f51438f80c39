// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/jacobian.h>
#include <haptic_sculpt/device/linear_algebra/singular_values.h>

namespace haptic_sculpt {

/// How near a pose is to a singular one.
template <class S> struct Conditioning {
  using Scalar = S;         ///< what `Outcome` measures a shortfall in
  S constraint_condition; ///< condition number of the velocity equations (rows u_i, and Q t_i; moments in units of l2)
  S distance_to_singular;   ///< their least singular value: 0 where the platform can move with its legs held
  S least_transmission;     ///< least |u_i.b_i'| / l1 = |cos gamma sin(beta - theta)|: 0 where a joint can turn without
                            ///< moving the platform
};

namespace internal {

/// The matrix of the velocity equations; 3 by 3 in the di-tetrahedral form, where the lower rows and right columns are
/// unused.
template <class S>
Eigen::Matrix<S, 6, 6> constraint_matrix(const Device_parameters<S>& parameters, const Device_pose<S>& pose) {
  Eigen::Matrix<S, 6, 6> a;
  for (int i = 0; i < 3; ++i) {
    const Device_vector<S> arm = (pose.elbows.col(i) - pose.position) * parameters.inverse_secondary_length();
    const Device_vector<S> u = pose.links.col(i), q = pose.orientation * Leg_frame<S>::tangential(i);
    a.row(i) << u.transpose(), arm.cross(u).transpose();
    a.row(3 + i) << q.transpose(), arm.cross(q).transpose();
  }
  return a;
}

} // namespace internal

/// Condition number and distances of a pose. A few microseconds. Failure: `singular` where the condition number is
/// infinite.
template <class S>
Outcome<Conditioning<S>> conditioning(const Device_parameters<S>& parameters, const Device_pose<S>& pose) {
  using std::abs;
  Outcome<Conditioning<S>> outcome;
  Conditioning<S>& c = outcome.value_to_fill();
  S greatest;
  if (parameters.form() == Device_form::ditetrahedral) {
    const Device_matrix<S> a = pose.links.transpose();
    const Device_vector<S> values = internal::singular_values<S, 3>(a);
    greatest = values[0], c.distance_to_singular = values[2];
  } else {
    const Eigen::Matrix<S, 6, 1> values =
        internal::singular_values<S, 6>(internal::constraint_matrix(parameters, pose));
    greatest = values[0], c.distance_to_singular = values[5];
  }
  for (int leg = 0; leg < 3; ++leg) {
    const S transmission = abs(pose.links.col(leg).dot(pose.elbow_rate(parameters, leg))) / parameters.primary_length();
    c.least_transmission = leg == 0 || transmission < c.least_transmission ? transmission : c.least_transmission;
  }
  c.constraint_condition = greatest / c.distance_to_singular;
  if (internal::is_finite(c.constraint_condition))
    outcome.succeed();
  else
    outcome.fail(Device_status::singular, S(0));
  return outcome;
}

/// How fast the platform's centre moves when the joints turn: the extreme singular values of the 3 by 3 position
/// Jacobian.
///
/// In the general form too this is the centre's translation alone, `Device_jacobian::linear`: its tilts are another
/// unit, and a force on the hand acts along translations. It is another number than
/// `Conditioning::constraint_condition`, which says how well the pose determines the Jacobian and is small at poses
/// where a knee is straight, while this one is infinite there.
template <class S> struct Translation_conditioning {
  using Scalar = S; ///< as of the Jacobian
  S greatest;  ///< m/rad: the centre's greatest speed at joint rates of norm 1
  S least;     ///< m/rad: its least; 0 where there is a direction in which the centre cannot move
  S condition; ///< greatest / least, at least 1; infinite where `least` is 0. Encoder steps turn a force by about their
               ///< size times this.
};

/// Extreme singular values and condition number of the position Jacobian. About a microsecond in double; no allocation.
/// \pre the Jacobian is finite, as that of a success is
template <class S> Translation_conditioning<S> translation_conditioning(const Device_jacobian<S>& jacobian) {
  const Device_vector<S> values = internal::singular_values<S, 3>(jacobian.linear);
  const S condition = values[2] > S(0) ? S(values[0] / values[2]) : std::numeric_limits<S>::infinity();
  return {values[0], values[2], condition};
}

} // namespace haptic_sculpt
