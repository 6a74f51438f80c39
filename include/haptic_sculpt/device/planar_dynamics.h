// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/dynamics_terms.h>

/// \file
/// The paper's Lagrangian (its equations 4 to 8): each secondary link counted as if it moved in its leg's vertical
/// plane.
///
/// That link has its full length l2 at the angle beta_i, the projection's angle. It is false for a ball elbow (the true
/// link leaves the plane by gamma_i, so part of its inertia is lost) and is here to be compared with. What the paper
/// leaves out is not left out: beta_i depends on all three joint angles, so d beta / d theta is a full matrix; l1 and
/// l2, m1 and m2 may differ.

namespace haptic_sculpt {

/// The links' projected angles: how they turn with the joints.
template <class S> struct Projected_links {
  using Scalar = S;                  ///< what `Outcome` measures a shortfall in
  Device_vector<S> cosine,           ///< of beta_i
      sine;                          ///< of beta_i
  Device_matrix<S> jacobian;         ///< d beta_i / d theta_j
  Device_matrix<S> jacobian_rate;    ///< its time derivative
  Device_vector<S> rate;             ///< d beta / dt
};

/// Failure: `singular` where a link stands normal to its leg plane, which leaves no projection to measure an angle of.
template <class S>
Outcome<Projected_links<S>> projected_links(const Device_parameters<S>& parameters, const Device_motion<S>& motion) {
  using std::sqrt;
  Outcome<Projected_links<S>> outcome;
  Projected_links<S>& links = outcome.value_to_fill();
  // Of links of length 1, no unit: of one that is shorter in its plane the direction has lost half of its digits.
  const S least_square = std::numeric_limits<S>::epsilon();
  for (int i = 0; i < 3; ++i) {
    Device_matrix<S> turn = motion.joint_jacobian(i), turn_rate = motion.joint_jacobian_rate(i);
    turn.col(i) -= motion.elbow_rates.col(i);
    turn_rate.col(i) -= motion.elbow_rates_derived.col(i);
    const S x = Leg_frame<S>::along_radial(i, motion.pose.links.col(i)), z = motion.pose.links(2, i),
            square = x * x + z * z;
    if (!(square > least_square)) {
      outcome.fail(Device_status::singular, S(0));
      return outcome;
    }
    const S scale = parameters.inverse_secondary_length(), length = sqrt(square);
    links.cosine[i] = x / length;
    links.sine[i] = z / length;
    Device_vector<S> dx, dz, ddx, ddz;
    for (int j = 0; j < 3; ++j) {
      dx[j] = Leg_frame<S>::along_radial(i, turn.col(j)) * scale;
      ddx[j] = Leg_frame<S>::along_radial(i, turn_rate.col(j)) * scale;
      dz[j] = turn(2, j) * scale;
      ddz[j] = turn_rate(2, j) * scale;
    }
    const S x_rate = dx.dot(motion.rate), z_rate = dz.dot(motion.rate), square_rate = S(2) * (x * x_rate + z * z_rate);
    const Device_vector<S> area = x * dz - z * dx, area_rate = x_rate * dz + x * ddz - z_rate * dx - z * ddx;
    links.jacobian.row(i) = (area / square).transpose();
    links.jacobian_rate.row(i) = (area_rate / square - area * (square_rate / (square * square))).transpose();
  }
  links.rate = links.jacobian * motion.rate;
  outcome.succeed();
  return outcome;
}

/// M, C, gravity and the energies of the paper's planar model. Failure: `singular`, see projected_links().
template <class S>
Outcome<Dynamics_terms<S>> planar_dynamics(const Device_parameters<S>& parameters, const Device_motion<S>& motion) {
  using namespace internal;
  const Outcome<Projected_links<S>> links = projected_links(parameters, motion);
  if (!links)
    return Outcome<Dynamics_terms<S>>(links.status(), links.shortfall());
  Outcome<Dynamics_terms<S>> outcome;
  Dynamics_terms<S>& terms = outcome.value_to_fill();
  shared_terms(parameters, motion, terms);
  const S& l2 = parameters.secondary_length();
  const S weight = parameters.secondary_mass() * parameters.gravity() / S(2);
  for (int i = 0; i < 3; ++i) {
    const Device_vector<S> across = Leg_frame<S>::in_leg_plane(i, -l2 * links->sine[i], l2 * links->cosine[i]);
    const Device_vector<S> inward = Leg_frame<S>::in_leg_plane(i, -l2 * links->cosine[i], -l2 * links->sine[i]);
    const Device_matrix<S> elbow = single_column<S>(motion.elbow_rates.col(i), i),
                           elbow_rate = single_column<S>(motion.elbow_rates_derived.col(i), i);
    const Device_matrix<S> end = elbow + across * links->jacobian.row(i);
    const Device_matrix<S> end_rate =
        elbow_rate + across * links->jacobian_rate.row(i) + (inward * links->rate[i]) * links->jacobian.row(i);
    add_rod(parameters.secondary_mass(), elbow, end, elbow_rate, end_rate, terms);
    terms.gravity += weight * (elbow.row(2) + end.row(2)).transpose();
    terms.potential += weight * (S(2) * motion.pose.elbows(2, i) + l2 * links->sine[i]);
  }
  finish_terms(motion, terms);
  outcome.succeed();
  return outcome;
}

} // namespace haptic_sculpt
