// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/dynamics.h>
#include <haptic_sculpt/device/forward_kinematics.h>
#include <haptic_sculpt/device/simulation/joint_friction.h>

/// \file
/// The classical Runge-Kutta step of the mechanism together with whatever moves with it: a hand, an integral that is
/// watched.

namespace haptic_sculpt {

/// Numbers beside the mechanism's own that change by a differential equation, each in its own unit.
template <class S, int count>
using Further_states = Eigen::Matrix<S, count, 1>;

/// The mechanism and further states at one instant.
template <class S, int count>
struct Coupled_state {
  using Scalar = S;                 ///< what `Outcome` measures a shortfall in
  Device_state<S> device;           ///< of the mechanism
  Further_states<S, count> further; ///< in the order in which the surroundings tell their rates
};

/// What surrounds the mechanism does at one instant.
template <class S, int count>
struct Surroundings_effect {
  Device_vector<S> torque;               ///< on the joints, N m: motors, and J^T times the hand's force on the platform
  Further_states<S, count> further_rate; ///< d/dt of the further states
};

/// One classical Runge-Kutta step of fourth order, of mechanism, joint friction and further states together.
///
/// `surroundings(motion, further, time)` gives the `Surroundings_effect`; motion is the `Device_motion` there, with
/// pose, joint rates, Jacobian and the platform's velocity. It is called four times and must be continuous for the step
/// to have its order: what jumps (a held torque) should jump between steps. Friction limits the step: Coulomb friction
/// is a damper of coulomb_friction / coulomb_rate() at rest, and a damper times the step over the mass matrix's least
/// eigenvalue must stay below 2.7.
///
/// Failures: those of the kinematics and dynamics at a stage; `not_finite` if the surroundings are; the state is
/// untouched then. Some ten microseconds in double; allocates nothing itself.
template <class S, int count, class Surroundings>
Outcome<Coupled_state<S, count>> runge_kutta_step(const Device_parameters<S>& parameters, Dynamics_model model,
                                                  const Coupled_state<S, count>& state, const S& time, const S& step,
                                                  const Surroundings& surroundings) {
  using V = Device_vector<S>;
  using Further = Further_states<S, count>;
  using Result = Outcome<Coupled_state<S, count>>;
  const Device_state<S>& start = state.device;
  V position_slope[4], rate_slope[4];
  Further further_slope[4];
  for (int stage = 0; stage < 4; ++stage) {
    const S ahead = stage == 0 ? S(0) : stage == 3 ? step : S(step / S(2));
    Device_pose<S> pose = start.pose;
    V rate = start.rate;
    Further further = state.further;
    if (stage > 0) {
      rate += ahead * rate_slope[stage - 1];
      further += ahead * further_slope[stage - 1];
      const Outcome<Device_pose<S>> moved =
          forward_kinematics(parameters, V(start.pose.theta + ahead * position_slope[stage - 1]), start.pose);
      if (!moved)
        return Result(moved.status(), moved.shortfall());
      pose = *moved;
    }
    const Outcome<Device_motion<S>> motion = device_motion(parameters, pose, rate);
    if (!motion)
      return Result(motion.status(), motion.shortfall());
    const Surroundings_effect<S, count> effect = surroundings(*motion, further, S(time + ahead));
    if (!internal::all_finite(effect.torque) || !internal::all_finite(effect.further_rate))
      return Result(Device_status::not_finite, S(0));
    const Outcome<Dynamics_terms<S>> terms = dynamics(parameters, model, *motion);
    if (!terms)
      return Result(terms.status(), terms.shortfall());
    position_slope[stage] = rate;
    rate_slope[stage] = terms->acceleration(rate, V(effect.torque + joint_friction(parameters, rate)));
    further_slope[stage] = effect.further_rate;
    if (!internal::all_finite(rate_slope[stage]))
      return Result(terms->acceleration_failure(), S(0));
  }
  const S sixth = step / S(6);
  const V theta = start.pose.theta +
                  sixth * (position_slope[0] + S(2) * (position_slope[1] + position_slope[2]) + position_slope[3]);
  const Outcome<Device_pose<S>> pose = forward_kinematics(parameters, theta, start.pose);
  if (!pose)
    return Result(pose.status(), pose.shortfall());
  Coupled_state<S, count> next;
  next.device.pose = *pose;
  next.device.rate = start.rate + sixth * (rate_slope[0] + S(2) * (rate_slope[1] + rate_slope[2]) + rate_slope[3]);
  next.further =
      state.further + sixth * (further_slope[0] + S(2) * (further_slope[1] + further_slope[2]) + further_slope[3]);
  if (!internal::all_finite(next.device.rate) || !internal::all_finite(next.further))
    return Result(Device_status::not_finite, S(0));
  return next;
}

} // namespace haptic_sculpt
