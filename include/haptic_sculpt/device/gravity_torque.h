// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/jacobian.h>

namespace haptic_sculpt {

/// The joint torques that hold the mechanism's weight, N m: the `gravity` of spatial_dynamics(), without the rest of
/// it.
///
/// Half of each secondary link's weight acts at its elbow, half at its platform joint. The three platform joints' mean
/// is the platform's centre, however it is tilted, so that the centre carries the platform and three half links: (M +
/// 3/2 m2) g. Nanoseconds; no allocation.
template <class S>
Device_vector<S> gravity_torque(const Device_parameters<S>& parameters, const Device_pose<S>& pose,
                                const Device_jacobian<S>& jacobian) {
  const S at_centre = (parameters.platform_mass() + S(3) / S(2) * parameters.secondary_mass()) * parameters.gravity();
  const S at_elbow = (parameters.primary_mass() + parameters.secondary_mass()) / S(2) * parameters.gravity() *
                     parameters.primary_length();
  Device_vector<S> torque;
  for (int joint = 0; joint < 3; ++joint)
    torque[joint] = at_centre * jacobian.linear(2, joint) + at_elbow * pose.cos_theta[joint];
  return torque;
}

} // namespace haptic_sculpt
