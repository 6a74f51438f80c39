// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/simulation/Torque_delay.h>
#include <haptic_sculpt/device/simulation/encoder.h>
#include <haptic_sculpt/device/simulation/runge_kutta.h>

/// \file
/// One tick of a sampled loop as the device lives through it: torques that are held and come late, a hand, friction.

namespace haptic_sculpt {

/// How many Runge-Kutta steps a tick is made of if not said: at 1 kHz 40 change the platform's place by less than a
/// micrometre.
constexpr int default_substeps = 2;

/// Moves mechanism and further states through one tick, of which `delay` says the torques in force.
///
/// The tick is split where the torque changes, so that every step integrates what is smooth; the `substeps` (at least
/// 2) are shared by length, at least one a part, and each part's are equal. `surroundings(motion, further, time)` gives
/// the torques beside those held, and the further states' rates; see runge_kutta_step(), whose failures these are.
template <class S, int count, class Surroundings>
Outcome<Coupled_state<S, count>> simulate_tick(const Device_parameters<S>& parameters, Dynamics_model model,
                                               const Coupled_state<S, count>& state, const S& time, const S& tick,
                                               const Torque_delay<S>& delay, const Surroundings& surroundings,
                                               int substeps = default_substeps) {
  const S fraction = delay.fraction();
  int first_steps = 0; // of the part with the older torque
  if (fraction > S(0)) {
    first_steps = 1;
    while (first_steps < substeps - 1 && S(2 * first_steps + 1) < S(2 * substeps) * fraction)
      ++first_steps;
  }
  const int all_steps = first_steps > 0 && substeps < 2 ? 2 : substeps < 1 ? 1 : substeps;
  Outcome<Coupled_state<S, count>> reached(state);
  for (int k = 0; k < all_steps && reached; ++k) {
    const bool first = k < first_steps;
    const S length =
        first ? S(fraction * tick / S(first_steps)) : S((S(1) - fraction) * tick / S(all_steps - first_steps));
    const S begin = first ? S(S(k) * length) : S(fraction * tick + S(k - first_steps) * length);
    const Device_vector<S>& held = first ? delay.before() : delay.after();
    reached =
        runge_kutta_step(parameters, model, *reached, S(time + begin), length,
                         [&](const Device_motion<S>& motion, const Further_states<S, count>& further, const S& now) {
                           Surroundings_effect<S, count> effect = surroundings(motion, further, now);
                           effect.torque += held;
                           return effect;
                         });
  }
  return reached;
}

} // namespace haptic_sculpt
