// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/Device_pose.h>

namespace haptic_sculpt::internal {

/// The six equations at a fixed platform position, in units of l2: of each leg (|link|^2 - 1) / 2 and arm . axis, with
/// the arm from the centre to the elbow, and their derivative by the joint angles and a rotation vector of the
/// platform.
template <class S>
struct Position_equations {
  Eigen::Matrix<S, 6, 1> f;                 ///< of the three legs their lengths, then their right angles
  Eigen::Matrix<S, 6, 6> derivative;        ///< by the three joint angles, then the rotation vector
  Device_vector<S> link_length, arm_length; ///< of each leg, in l2

  /// \param pose its elbows are those of its angles
  Position_equations(const Device_parameters<S>& parameters, const Device_vector<S>& position,
                     const Device_pose<S>& pose) {
    using std::sqrt;
    const S scale = parameters.inverse_secondary_length(), r = parameters.platform_radius() * scale;
    derivative.setZero();
    for (int i = 0; i < 3; ++i) {
      const Device_vector<S> axis = pose.orientation * Leg_frame<S>::tangential(i);
      const Device_vector<S> rate = pose.elbow_rate(parameters, i) * scale,
                             arm = (pose.elbows.col(i) - position) * scale;
      const Device_vector<S> lever = r * (pose.orientation * Leg_frame<S>::radial(i)), link = lever - arm;
      const S square = link.squaredNorm();
      link_length[i] = sqrt(square), arm_length[i] = sqrt(S(arm.squaredNorm()));
      f[i] = (square - S(1)) / S(2);
      f[3 + i] = arm.dot(axis);
      derivative(i, i) = -link.dot(rate);
      derivative(3 + i, i) = rate.dot(axis);
      derivative.template block<1, 3>(i, 3) = lever.cross(link).transpose();
      derivative.template block<1, 3>(3 + i, 3) = axis.cross(arm).transpose();
    }
  }
};

} // namespace haptic_sculpt::internal
