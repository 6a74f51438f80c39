// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/Device_parameters.h>
#include <haptic_sculpt/device/Outcome.h>

namespace haptic_sculpt {

/// Where every part of the mechanism is, in world axes (z up, origin at the centre of the base circle, metres).
///
/// Made by the forward and inverse kinematics, never by hand. Columns of the matrices belong to legs.
template <class S> struct Device_pose {
  using Scalar = S; ///< what `Outcome` measures a shortfall in

  Device_form form = Device_form::ditetrahedral; ///< of the parameters it was made with
  int mode = 0; ///< di-tetrahedral: +1 apex above the elbow plane (seen along its normal), -1 below; general: 0
  Device_vector<S> theta;         ///< joint angles: 0 radially outward, pi/2 up
  Device_vector<S> cos_theta;     ///< of each joint angle, as computed on the way
  Device_vector<S> sin_theta;     ///< the same
  Device_matrix<S> elbows;        ///< B_i
  Device_matrix<S> joints;        ///< P_i; the three are equal in the di-tetrahedral form
  Device_matrix<S> links;         ///< u_i, unit vectors from elbow to platform joint
  Device_vector<S> position;      ///< p, apex or platform centre
  Device_matrix<S> orientation;   ///< Q, columns are the platform's axes; the identity in the di-tetrahedral form
  Device_vector<S>
      cos_phi; ///< general form: link angles seen from the platform, B_i = P_i + l2 (cos phi_i Q e_i + sin phi_i Q k)
  Device_vector<S> sin_phi;       ///< general form, as cos_phi; the di-tetrahedral form sets neither

  /// dB_i/dtheta_i.
  Device_vector<S> elbow_rate(const Device_parameters<S>& parameters, int leg) const {
    const S& l1 = parameters.primary_length();
    return Leg_frame<S>::in_leg_plane(leg, -l1 * sin_theta[leg], l1 * cos_theta[leg]);
  }
  /// Link angles phi_i in (-pi, pi]; general form.
  Device_vector<S> phi() const {
    using std::atan2;
    return {atan2(sin_phi[0], cos_phi[0]), atan2(sin_phi[1], cos_phi[1]), atan2(sin_phi[2], cos_phi[2])};
  }
  /// beta_i, the secondary link's absolute angle in the projection on its leg plane.
  Device_vector<S> beta() const {
    using std::atan2;
    Device_vector<S> angles;
    for (int leg = 0; leg < 3; ++leg)
      angles[leg] = atan2(links(2, leg), Leg_frame<S>::along_radial(leg, links.col(leg)));
    return angles;
  }
  /// gamma_i, the secondary link's angle out of its leg plane.
  Device_vector<S> gamma() const {
    using std::atan2;
    using std::sqrt;
    Device_vector<S> angles;
    for (int leg = 0; leg < 3; ++leg) {
      const S across = Leg_frame<S>::along_tangential(leg, links.col(leg));
      const S radial = Leg_frame<S>::along_radial(leg, links.col(leg));
      angles[leg] = atan2(across, sqrt(radial * radial + links(2, leg) * links(2, leg)));
    }
    return angles;
  }
};

namespace internal {

/// Fills in angles and elbows. False if an angle is not finite.
template <class S>
inline bool place_elbows(const Device_parameters<S>& parameters, const Device_vector<S>& theta, Device_pose<S>& pose) {
  using std::cos;
  using std::sin;
  pose.form = parameters.form();
  pose.theta = theta;
  const S base = parameters.base_radius(), length = parameters.primary_length();
  for (int leg = 0; leg < 3; ++leg) {
    const S angle = theta[leg], sine = sin(angle), cosine = cos(angle); // side by side: compilers make one call of them
    pose.sin_theta[leg] = sine;
    pose.cos_theta[leg] = cosine;
    pose.elbows.col(leg) = Leg_frame<S>::in_leg_plane(leg, base + length * cosine, length * sine);
  }
  return all_finite(pose.sin_theta); // the sine of what is not finite is not a number
}

/// Whether a triangle with the sides a, b (squares given) and normal n = a x b (square given) has a usable normal. Its
/// corners, at a distance of about `size` from the origin, are uncertain by the rounding of that distance, which turns
/// the normal by rounding times longest side over |n|: at 16 roundings there is no knowing where it points. Collinear
/// and coincident corners both fail.
template <class S> bool spans_a_plane(const S& normal_squared, const S& aa, const S& bb, const S& size) {
  const S limit = S(16) * std::numeric_limits<S>::epsilon() * size;
  return normal_squared > limit * limit * (aa > bb ? aa : bb);
}

} // namespace internal

/// Moving state of the mechanism: angles, their rates, and the pose they belong to (which carries the assembly mode
/// on).
template <class S = double> struct Device_state {
  using Scalar = S;                                 ///< what `Outcome` measures a shortfall in
  Device_pose<S> pose;                              ///< with the joint angles, `pose.theta`
  Device_vector<S> rate = Device_vector<S>::Zero(); ///< dtheta/dt, rad/s
};

} // namespace haptic_sculpt
