// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// What the tests of the simulation share; in the namespace of their suite.

#include "device/populations.h"

#include <cmath>

namespace device_simulation {

using namespace device_populations;
using Vector = Device_vector<double>;
using Long = long double;
constexpr unsigned seed = 20250311;
constexpr Device_form both_forms[] = {Device_form::ditetrahedral, Device_form::general};

inline Device_description<double> with_friction(Device_description<double> d, double viscous, double coulomb) {
  d.viscous_friction = viscous, d.coulomb_friction = coulomb;
  return d;
}

/// A hand: a mass, moved by a spring and a damper that follow a path, that holds the platform's centre by another
/// spring and damper. Place and velocity of its mass are the first six further states; then come, if there is room, the
/// work of the path and of friction done so far.
template <class S, int count>
struct Hand {
  const Device_parameters<S>& parameters;
  Device_vector<S> centre;
  S mass = S(1.46), arm_stiffness = S(48.8), arm_damping = S(4.5), grip_stiffness = S(375), grip_damping = S(7.9);

  Surroundings_effect<S, count> operator()(const Device_motion<S>& motion, const Further_states<S, count>& y,
                                           const S& time) const {
    using std::cos;
    using std::sin;
    const Device_vector<S> place = y.template head<3>(), velocity = y.template segment<3>(3);
    const Device_vector<S> swing(S(0.012), S(-0.008), S(0.006)), target = centre + sin(S(20) * time) * swing,
                                                                 speed = (S(20) * cos(S(20) * time)) * swing;
    const Device_vector<S> arm = arm_stiffness * (target - place) + arm_damping * (speed - velocity);
    const Device_vector<S> grip =
        grip_stiffness * (place - motion.pose.position) + grip_damping * (velocity - motion.velocity.linear);
    Surroundings_effect<S, count> effect;
    effect.torque = motion.jacobian.linear.transpose() * grip;
    effect.further_rate.setZero();
    effect.further_rate.template head<3>() = velocity;
    effect.further_rate.template segment<3>(3) = (arm - grip) / mass;
    if constexpr (count > 6) { // work of the path's spring on the hand, and what damping, friction and gravity
                               // compensation take or give
      effect.further_rate[6] = arm.dot(velocity);
      effect.further_rate[7] = joint_friction(parameters, motion.rate).dot(motion.rate);
      effect.further_rate[8] = grip.dot(motion.velocity.linear - velocity); // what the grip's spring and damper take
      const Device_vector<S> carried = gravity_torque(parameters, motion.pose, motion.jacobian);
      effect.torque += carried;
      effect.further_rate[9] = carried.dot(motion.rate);
    }
    return effect;
  }
};

template <class S, int count>
Coupled_state<S, count> at_rest(const Device_parameters<S>& parameters, const Device_vector<S>& theta) {
  Coupled_state<S, count> state;
  state.device.pose = *forward_kinematics(parameters, theta);
  state.further.setZero();
  state.further.template head<3>() = state.device.pose.position;
  return state;
}

} // namespace device_simulation
