// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/simulation/simulation.h>

namespace haptic_sculpt {

/// One step of the three-stage Gauss collocation on angles and momenta: sixth order, symplectic and time-reversible, so
/// for torques that come from a potential the energy error stays bounded by a multiple of step^6 for all time.
///
/// The stages are found by fixed-point iteration, to rounding. Failures: those of a stage; `diverged` if the step is
/// too long for the iteration, shortfall the last change (rad).
template <class S, class Torque>
Outcome<Device_state<S>> symplectic_step(const Device_parameters<S>& parameters, Dynamics_model model,
                                         const Device_state<S>& state, const S& time, const S& step,
                                         const Torque& torque) {
  using V = Device_vector<S>;
  using std::sqrt;
  const S root = sqrt(S(15));
  const S nodes[3] = {S(0.5) - root / S(10), S(0.5), S(0.5) + root / S(10)};
  const S weights[3] = {S(5) / S(18), S(4) / S(9), S(5) / S(18)};
  const S matrix[3][3] = {{S(5) / S(36), S(2) / S(9) - root / S(15), S(5) / S(36) - root / S(30)},
                          {S(5) / S(36) + root / S(24), S(2) / S(9), S(5) / S(36) - root / S(24)},
                          {S(5) / S(36) + root / S(30), S(2) / S(9) + root / S(15), S(5) / S(36)}};
  const Outcome<Dynamics_terms<S>> now = dynamics(parameters, model, state.pose, state.rate);
  if (!now)
    return Outcome<Device_state<S>>(now.status(), now.shortfall());
  const V momentum = now->mass * state.rate;
  V slopes[3], forces[3]; // dtheta/dt and d(momentum)/dt at the stages
  Device_pose<S> poses[3];
  const V force = now->coriolis.transpose() * state.rate - now->gravity + torque(state.pose, state.rate, time) +
                  joint_friction(parameters, state.rate);
  for (int i = 0; i < 3; ++i)
    slopes[i] = state.rate, forces[i] = force, poses[i] = state.pose;
  S previous_change(0);
  bool settled = false;
  for (int iteration = 0; iteration < 60 && !settled; ++iteration) {
    S change(0);
    V new_slopes[3], new_forces[3];
    for (int i = 0; i < 3; ++i) {
      V turned = V::Zero(), pushed = V::Zero();
      for (int j = 0; j < 3; ++j)
        turned += matrix[i][j] * slopes[j], pushed += matrix[i][j] * forces[j];
      const Outcome<Device_pose<S>> pose =
          forward_kinematics(parameters, V(state.pose.theta + step * turned), poses[i]);
      if (!pose)
        return Outcome<Device_state<S>>(pose.status(), pose.shortfall());
      poses[i] = *pose;
      // The mass matrix does not depend on the rate, but the forces do: the rate that belongs to the momentum comes
      // first.
      Outcome<Dynamics_terms<S>> terms = dynamics(parameters, model, poses[i], slopes[i]);
      if (!terms)
        return Outcome<Device_state<S>>(terms.status(), terms.shortfall());
      new_slopes[i] = terms->solve_mass(V(momentum + step * pushed));
      terms = dynamics(parameters, model, poses[i], new_slopes[i]);
      if (!terms)
        return Outcome<Device_state<S>>(terms.status(), terms.shortfall());
      new_forces[i] = terms->coriolis.transpose() * new_slopes[i] - terms->gravity +
                      torque(poses[i], new_slopes[i], S(time + nodes[i] * step)) +
                      joint_friction(parameters, new_slopes[i]);
      const S turn = internal::largest_magnitude(V(step * (new_slopes[i] - slopes[i])));
      change = turn > change ? turn : change;
    }
    for (int i = 0; i < 3; ++i)
      slopes[i] = new_slopes[i], forces[i] = new_forces[i];
    if (!internal::is_finite(change))
      return Outcome<Device_state<S>>(Device_status::diverged, S(0));
    const S epsilon = std::numeric_limits<S>::epsilon();
    settled = change <= epsilon / S(4) || (iteration > 3 && change <= S(64) * epsilon && !(change < previous_change));
    previous_change = change;
  }
  if (!settled)
    return Outcome<Device_state<S>>(Device_status::diverged, previous_change);
  V turned = V::Zero(), pushed = V::Zero();
  for (int i = 0; i < 3; ++i)
    turned += weights[i] * slopes[i], pushed += weights[i] * forces[i];
  const Outcome<Device_pose<S>> pose = forward_kinematics(parameters, V(state.pose.theta + step * turned), poses[2]);
  if (!pose)
    return Outcome<Device_state<S>>(pose.status(), pose.shortfall());
  const Outcome<Dynamics_terms<S>> end = dynamics(parameters, model, *pose, V(slopes[2]));
  if (!end)
    return Outcome<Device_state<S>>(end.status(), end.shortfall());
  return Device_state<S>{*pose, end->solve_mass(V(momentum + step * pushed))};
}

} // namespace haptic_sculpt
