// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/Device_parameters.h>

namespace haptic_sculpt {

/// The joint rate within which Coulomb friction turns over from one direction to the other, rad/s: at it, 76 % of the
/// whole is there.
///
/// A step function would make the equations of motion discontinuous, and no integrator keep its order. At 0.02 rad/s a
/// joint at rest creeps by less than a milliradian in 50 ms, which no hand feels.
template <class S>
S coulomb_rate() {
  return S(2) / S(100);
}

/// The torques of friction on the joints, N m, each against its joint's rate: viscous times rate, and Coulomb times
/// tanh(rate / coulomb_rate()).
///
/// Never puts energy in: its power, friction . rate, is at most 0.
template <class S>
Device_vector<S> joint_friction(const Device_parameters<S>& parameters, const Device_vector<S>& rate) {
  using std::tanh;
  const S& viscous = parameters.viscous_friction();
  const S& coulomb = parameters.coulomb_friction();
  Device_vector<S> torque = Device_vector<S>::Zero();
  if (viscous == S(0) && coulomb == S(0))
    return torque;
  for (int joint = 0; joint < 3; ++joint)
    torque[joint] = -(viscous * rate[joint] + coulomb * tanh(S(rate[joint] / coulomb_rate<S>())));
  return torque;
}

} // namespace haptic_sculpt
