// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/dynamics_terms.h>

/// \file
/// The full rigid-body model, the default: links are slender rods that move in space, elbows are ball joints.

namespace haptic_sculpt {

/// M, C, gravity and the energies of the spatial model.
template <class S>
Dynamics_terms<S> spatial_dynamics(const Device_parameters<S>& parameters, const Device_motion<S>& motion) {
  using namespace internal;
  Dynamics_terms<S> terms;
  shared_terms(parameters, motion, terms);
  const S weight = parameters.secondary_mass() * parameters.gravity() / S(2);
  for (int leg = 0; leg < 3; ++leg) {
    const Device_matrix<S> elbow = single_column<S>(motion.elbow_rates.col(leg), leg),
                           joint = motion.joint_jacobian(leg);
    add_rod(parameters.secondary_mass(), elbow, joint, single_column<S>(motion.elbow_rates_derived.col(leg), leg),
            motion.joint_jacobian_rate(leg), terms);
    terms.gravity += weight * (elbow.row(2) + joint.row(2)).transpose();
    terms.potential += weight * (motion.pose.elbows(2, leg) + motion.pose.joints(2, leg));
  }
  finish_terms(motion, terms);
  return terms;
}

/// Joint torques for given rates and accelerations, spatial model, by forces and accelerations without forming M and C.
///
/// Failures: `singular`, `not_finite`. About 0.3 microseconds in double; no allocation.
template <class S>
Outcome<Joint_torques<S>> spatial_inverse_dynamics(const Device_parameters<S>& parameters, const Device_pose<S>& pose,
                                                   const Device_vector<S>& rate, const Device_vector<S>& acceleration) {
  Outcome<Joint_torques<S>> outcome;
  const Velocity_map<S> map(parameters, pose);
  if (!map.is_regular()) {
    outcome.fail(Device_status::singular, S(0));
    return outcome;
  }
  const bool general = parameters.form() == Device_form::general;
  const S& l1 = parameters.primary_length();
  const S& g = parameters.gravity();
  Device_jacobian<S> jacobian;
  internal::jacobian_columns(parameters, pose, map, jacobian);
  const Device_vector<S> v = jacobian.linear * rate, w = jacobian.angular * rate;

  // Accelerations: |P - B| = l2 and (B - p).Q t = 0, differentiated twice.
  Device_matrix<S> elbow_acceleration, turning; // columns a leg; turning: w x (w x (P - p))
  Device_vector<S> link, axis = Device_vector<S>::Zero();
  for (int i = 0; i < 3; ++i) {
    const Device_vector<S> elbow_rate = pose.elbow_rate(parameters, i), elbow_velocity = elbow_rate * rate[i];
    const S centripetal = -l1 * rate[i] * rate[i];
    elbow_acceleration.col(i) =
        elbow_rate * acceleration[i] +
        Leg_frame<S>::in_leg_plane(i, centripetal * pose.cos_theta[i], centripetal * pose.sin_theta[i]);
    if (general) {
      const Device_vector<S> lever = pose.joints.col(i) - pose.position, turn = w.cross(lever),
                             slip = v + turn - elbow_velocity;
      turning.col(i) = w.cross(turn);
      link[i] = pose.links.col(i).dot(elbow_acceleration.col(i) - turning.col(i)) -
                slip.squaredNorm() * parameters.inverse_secondary_length();
      const Device_vector<S> q = pose.orientation * Leg_frame<S>::tangential(i), q_rate = w.cross(q);
      const Device_vector<S> arm = pose.elbows.col(i) - pose.position;
      axis[i] = q.dot(elbow_acceleration.col(i)) + S(2) * q_rate.dot(elbow_velocity - v) + arm.dot(w.cross(q_rate));
    } else {
      link[i] = pose.links.col(i).dot(elbow_acceleration.col(i)) -
                (v - elbow_velocity).squaredNorm() * parameters.inverse_secondary_length();
    }
  }
  const Twist<S> platform = map.solve(link, axis);

  // Forces: each rod acts on its two ends like the consistent masses of a uniform rod.
  const S third = parameters.secondary_mass() / S(3);
  const S primary = parameters.primary_mass() * l1 * l1 / S(3) + parameters.rotor_inertia();
  Device_vector<S> force = parameters.platform_mass() * platform.linear, moment = Device_vector<S>::Zero();
  force[2] += parameters.platform_mass() * g;
  Device_vector<S>& torque = outcome.value_to_fill().torque;
  for (int i = 0; i < 3; ++i) {
    Device_vector<S> at_elbow = elbow_acceleration.col(i), at_joint = platform.linear;
    if (general)
      at_joint += platform.angular.cross(pose.joints.col(i) - pose.position) + turning.col(i);
    at_elbow[2] += g;
    at_joint[2] += g;
    const Device_vector<S> on_elbow = third * (at_elbow + at_joint / S(2)),
                           on_joint = third * (at_joint + at_elbow / S(2));
    force += on_joint;
    if (general)
      moment += (pose.joints.col(i) - pose.position).cross(on_joint);
    torque[i] = pose.elbow_rate(parameters, i).dot(on_elbow) + primary * acceleration[i] +
                parameters.primary_mass() * g * l1 / S(2) * pose.cos_theta[i];
  }
  if (general) {
    const Device_vector<S>& moments = parameters.platform_inertia();
    const Device_vector<S> turn = pose.orientation.transpose() * w,
                           turn_rate = pose.orientation.transpose() * platform.angular;
    const Device_vector<S> momentum = moments.cwiseProduct(turn);
    moment += pose.orientation * (moments.cwiseProduct(turn_rate) + turn.cross(momentum));
  }
  torque += jacobian.torque(force, moment);
  if (internal::all_finite(torque))
    outcome.succeed();
  else
    outcome.fail(Device_status::not_finite, S(0));
  return outcome;
}

} // namespace haptic_sculpt
