// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/velocity_map.h>

namespace haptic_sculpt {

/// The platform's motion per joint rate: column j is the twist for joint j turning at 1 rad/s, the others held.
template <class S> struct Device_jacobian {
  using Scalar = S;         ///< what `Outcome` measures a shortfall in
  Device_matrix<S> linear;  ///< m; the position Jacobian
  Device_matrix<S> angular; ///< 1; zero in the di-tetrahedral form

  /// Joint torques that hold a force and a moment applied by the platform to the hand: tau = J^T w.
  Device_vector<S> torque(const Device_vector<S>& force, const Device_vector<S>& moment) const {
    return linear.transpose() * force + angular.transpose() * moment;
  }
};

namespace internal {

template <class S>
void jacobian_columns(const Device_parameters<S>& parameters, const Device_pose<S>& pose, const Velocity_map<S>& map,
                      Device_jacobian<S>& jacobian) {
  for (int leg = 0; leg < 3; ++leg) {
    const Device_vector<S> rate = pose.elbow_rate(parameters, leg);
    Device_vector<S> link = Device_vector<S>::Zero(), axis = Device_vector<S>::Zero();
    link[leg] = pose.links.col(leg).dot(rate);
    if (parameters.form() == Device_form::general)
      axis[leg] = (pose.orientation * Leg_frame<S>::tangential(leg)).dot(rate);
    const Twist<S> twist = map.solve(link, axis);
    jacobian.linear.col(leg) = twist.linear;
    jacobian.angular.col(leg) = twist.angular;
  }
}

} // namespace internal

/// The Jacobian of a pose. Failure: `singular`.
template <class S>
Outcome<Device_jacobian<S>> jacobian(const Device_parameters<S>& parameters, const Device_pose<S>& pose) {
  Outcome<Device_jacobian<S>> outcome;
  const Velocity_map<S> map(parameters, pose);
  if (!map.is_regular()) {
    outcome.fail(Device_status::singular, S(0));
    return outcome;
  }
  internal::jacobian_columns(parameters, pose, map, outcome.value_to_fill());
  if (internal::all_finite(outcome->linear) && internal::all_finite(outcome->angular))
    outcome.succeed();
  else
    outcome.fail(Device_status::singular, S(0));
  return outcome;
}

/// A pose with everything that moves: rates, the Jacobian and its time derivative. What both dynamic models start from.
template <class S> struct Device_motion {
  using Scalar = S;                     ///< what `Outcome` measures a shortfall in
  Device_pose<S> pose;                  ///< as given
  Device_vector<S> rate;                ///< dtheta/dt, rad/s, as given
  Device_jacobian<S> jacobian;          ///< of that pose
  Device_jacobian<S> jacobian_rate;     ///< d/dt of the Jacobian along `rate`
  Twist<S> velocity;                    ///< of the platform
  Device_matrix<S> elbow_rates;         ///< column i: dB_i/dtheta_i
  Device_matrix<S> elbow_rates_derived; ///< column i: d/dt of that

  /// P_i - p, world axes.
  Device_vector<S> lever(int leg) const { return pose.joints.col(leg) - pose.position; }
  /// Jacobian of platform joint P_i.
  Device_matrix<S> joint_jacobian(int leg) const {
    if (pose.form == Device_form::ditetrahedral)
      return jacobian.linear;
    return jacobian.linear + carried(jacobian.angular, lever(leg));
  }
  /// d/dt of the Jacobian of platform joint P_i.
  Device_matrix<S> joint_jacobian_rate(int leg) const {
    if (pose.form == Device_form::ditetrahedral)
      return jacobian_rate.linear;
    const Device_vector<S> arm = lever(leg);
    return jacobian_rate.linear + carried(jacobian_rate.angular, arm) +
           carried(jacobian.angular, velocity.angular.cross(arm));
  }
  /// The platform's acceleration for given joint accelerations.
  Twist<S> acceleration(const Device_vector<S>& joint_acceleration) const {
    return {jacobian.linear * joint_acceleration + jacobian_rate.linear * rate,
            jacobian.angular * joint_acceleration + jacobian_rate.angular * rate};
  }

private:
  static Device_matrix<S> carried(const Device_matrix<S>& angular, const Device_vector<S>& arm) {
    Device_matrix<S> m;
    for (int j = 0; j < 3; ++j)
      m.col(j) = angular.col(j).cross(arm);
    return m;
  }
};

/// Jacobian and its time derivative along `rate`, from the differentiated velocity equations. Failure: `singular`,
/// `not_finite`.
template <class S>
Outcome<Device_motion<S>> device_motion(const Device_parameters<S>& parameters, const Device_pose<S>& pose,
                                        const Device_vector<S>& rate) {
  Outcome<Device_motion<S>> outcome;
  Device_motion<S>& m = outcome.value_to_fill();
  m.pose = pose;
  m.rate = rate;
  if (!internal::all_finite(rate)) {
    outcome.fail(Device_status::not_finite, S(0));
    return outcome;
  }
  const Velocity_map<S> map(parameters, pose);
  if (!map.is_regular()) {
    outcome.fail(Device_status::singular, S(0));
    return outcome;
  }
  const bool general = parameters.form() == Device_form::general;
  internal::jacobian_columns(parameters, pose, map, m.jacobian);
  m.velocity.linear = m.jacobian.linear * rate;
  m.velocity.angular = m.jacobian.angular * rate;
  const Device_vector<S>& v = m.velocity.linear;
  const Device_vector<S>& w = m.velocity.angular;
  Device_matrix<S> link, axis = Device_matrix<S>::Zero(); // right-hand sides: row i equation, column j joint
  const S& l1 = parameters.primary_length();
  for (int i = 0; i < 3; ++i) {
    m.elbow_rates.col(i) = pose.elbow_rate(parameters, i);
    m.elbow_rates_derived.col(i) =
        Leg_frame<S>::in_leg_plane(i, -l1 * pose.cos_theta[i] * rate[i], -l1 * pose.sin_theta[i] * rate[i]);
    const Device_vector<S> elbow_velocity = m.elbow_rates.col(i) * rate[i];
    const Device_vector<S> arm = pose.elbows.col(i) - pose.position, arm_rate = elbow_velocity - v;
    const Device_vector<S> joint_velocity = general ? Device_vector<S>(v + w.cross(m.lever(i))) : v;
    const Device_vector<S> u = pose.links.col(i),
                           u_rate = (joint_velocity - elbow_velocity) * parameters.inverse_secondary_length();
    const Device_vector<S> q =
        general ? Device_vector<S>(pose.orientation * Leg_frame<S>::tangential(i)) : Device_vector<S>::Zero();
    const Device_vector<S> q_rate = w.cross(q);
    for (int j = 0; j < 3; ++j) {
      Device_vector<S> relative = -m.jacobian.linear.col(j), drift = Device_vector<S>::Zero();
      if (general) {
        relative -= m.jacobian.angular.col(j).cross(arm);
        drift -= m.jacobian.angular.col(j).cross(arm_rate);
      }
      if (i == j) {
        relative += m.elbow_rates.col(i);
        drift += m.elbow_rates_derived.col(i);
      }
      link(i, j) = u_rate.dot(relative) + u.dot(drift);
      if (general)
        axis(i, j) = q_rate.dot(relative) + q.dot(drift);
    }
  }
  for (int j = 0; j < 3; ++j) {
    const Twist<S> twist = map.solve(link.col(j), axis.col(j));
    m.jacobian_rate.linear.col(j) = twist.linear;
    m.jacobian_rate.angular.col(j) = twist.angular;
  }
  if (internal::all_finite(m.jacobian_rate.linear) && internal::all_finite(m.jacobian_rate.angular))
    outcome.succeed();
  else
    outcome.fail(Device_status::not_finite, S(0));
  return outcome;
}

} // namespace haptic_sculpt
