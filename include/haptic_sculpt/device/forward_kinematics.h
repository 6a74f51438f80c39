// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/ditetrahedral_kinematics.h>
#include <haptic_sculpt/device/general_kinematics.h>

/// \file
/// Forward kinematics of whichever form the parameters have.

namespace haptic_sculpt {

/// The pose in the home mode: apex or platform above its elbows; of a mirror design the mirror pose, wherever that is.
/// Failures as of the form's own function.
template <class S>
Outcome<Device_pose<S>> forward_kinematics(const Device_parameters<S>& parameters, const Device_vector<S>& theta) {
  return parameters.form() == Device_form::general ? general_forward(parameters, theta)
                                                   : ditetrahedral_forward(parameters, theta, 1);
}

/// The pose at `theta` in the assembly mode of `previous`. Failures as of the form's own function.
template <class S>
Outcome<Device_pose<S>> forward_kinematics(const Device_parameters<S>& parameters, const Device_vector<S>& theta,
                                           const Device_pose<S>& previous) {
  return parameters.form() == Device_form::general ? general_forward(parameters, theta, previous)
                                                   : ditetrahedral_forward(parameters, theta, previous.mode);
}

} // namespace haptic_sculpt
