// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Force_renderer.h>
#include <haptic_sculpt/haptic_rendering/Loop_parameters.h>
#include <haptic_sculpt/haptic_rendering/Watchdog.h>

namespace haptic_sculpt {

/// How a loop runs on a device of joints and torques.
struct Haptic_parameters : Loop_parameters {
  Watchdog_limits watchdog;                                     ///< beyond them the loop lets go
  Gravity_compensation gravity = Gravity_compensation::spatial; ///< unless it is changed
  /// Where the device has less friction at its handle than the coupling needs, the force is less: beyond the scene as
  /// it was loaded. false: for measuring what a coupling that is not passive does.
  bool follows_pose = true;

  /// The coupling, as stiff as it and the snap are together: what has to be passive.
  Virtual_coupling stiffest() const { return {coupling.stiffness + snap.stiffness(), coupling.damping}; }
  /// That it needs at the handle to be passive, N s/m.
  double needed_friction() const {
    return stiffest().stiffness * tick * (1 + 2 * delay) / 2 + std::abs(coupling.damping);
  }

  /// \throw Error naming what no device can use
  void check() const {
    internal::require_number("tick, the time of one,", "s", tick, Force_chain::least_tick, Force_chain::most_tick);
    internal::require_number("delay, to the force,", "ticks", delay, 0, Torque_delay<double>::most_ticks);
    coupling.check(), snap.check(), limits.check(), watchdog.check(), virtual_mass.check();
    internal::require_number("the stiffness of the coupling and that of the snap, 2 force / length, together", "N/m",
                             stiffest().stiffness, 0, Virtual_coupling::most_stiffness);
    internal::require_number("controller_damping, of the passivity controller,", "N s/m",
                             controller_damping.value_or(0), 0, 1e5);
    internal::require_reach("reach, of a grab,", reach);
    internal::require_number("button_quiet_time", "s", button_quiet_time, 0, 1);
    internal::require_number("work_limit, of a drag,", "pairs", static_cast<double>(work_limit), 1, 1e15);
    internal::require_number("work_of_a_face, of a drag,", "pairs", static_cast<double>(work_of_a_face), 0, 1e6);
  }
};

} // namespace haptic_sculpt
