// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/simulation/runge_kutta.h>

/// \file
/// Time stepping of the mechanism alone. The coordinates are the three joint angles, and every stage solves the
/// kinematics anew, so the constraints hold to rounding at any time: there is nothing to drift. Joint friction (the
/// parameters') is part of the motion.

namespace haptic_sculpt {

/// One classical Runge-Kutta step of fourth order. `torque(pose, rate, time)` gives the joint torques.
///
/// Failures: those of the kinematics and dynamics at a stage, and `not_finite` torques; the state is untouched then.
template <class S, class Torque>
Outcome<Device_state<S>> runge_kutta_step(const Device_parameters<S>& parameters, Dynamics_model model,
                                          const Device_state<S>& state, const S& time, const S& step,
                                          const Torque& torque) {
  const auto surroundings = [&](const Device_motion<S>& motion, const Further_states<S, 0>& none, const S& now) {
    return Surroundings_effect<S, 0>{torque(motion.pose, motion.rate, now), none};
  };
  const Outcome<Coupled_state<S, 0>> next =
      runge_kutta_step(parameters, model, Coupled_state<S, 0>{state, Further_states<S, 0>()}, time, step, surroundings);
  return next ? Outcome<Device_state<S>>(next->device) : Outcome<Device_state<S>>(next.status(), next.shortfall());
}

} // namespace haptic_sculpt
