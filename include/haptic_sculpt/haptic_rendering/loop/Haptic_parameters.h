// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Debounced_button.h>
#include <haptic_sculpt/haptic_rendering/Force_renderer.h>
#include <haptic_sculpt/haptic_rendering/Vertex_snap.h>
#include <haptic_sculpt/haptic_rendering/Virtual_mass.h>
#include <haptic_sculpt/haptic_rendering/Watchdog.h>

#include <optional>

namespace haptic_sculpt {

/// How a loop runs.
struct Haptic_parameters {
  double tick = 0.001;       ///< s
  double delay = 0;          ///< from a command to its torque, ticks
  Virtual_coupling coupling; ///< between hand and tool; refused where it is not passive
  Vertex_snap snap;          ///< of a hand that holds no vertex; off by default
  Force_limits limits;       ///< of what reaches the hand
  Watchdog_limits watchdog;  ///< beyond them the loop lets go
  Gravity_compensation gravity = Gravity_compensation::spatial; ///< unless it is changed
  Virtual_mass_parameters virtual_mass;                         ///< of what is grabbed; off by default
  /// The most that the passivity controller may damp, N s/m; 0: there is none. Nothing: half of what may be asked for.
  std::optional<double> controller_damping;
  /// Where the device has less friction at its handle than the coupling needs, the force is less: beyond the scene as
  /// it was loaded. false: for measuring what a coupling that is not passive does.
  bool follows_pose = true;
  double reach = 0.001; ///< of a grab, m in the device
  /// For which the button has to be quiet before its next change counts, s: contacts bounce. 0: all changes count.
  double button_quiet_time = Debounced_button::default_quiet_time;
  std::size_t work_limit = 400;   ///< pairs a drag may decide (doc/use/work.md)
  /// Pairs more for each face about the vertex in hand, up to most_work_of_faces or one a face.
  std::size_t work_of_a_face = 4;
  static constexpr std::size_t most_work_of_faces = 1024; ///< pairs; some 0.3 ms

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
