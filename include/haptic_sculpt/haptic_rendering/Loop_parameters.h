// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Debounced_button.h>
#include <haptic_sculpt/haptic_rendering/Force_limit.h>
#include <haptic_sculpt/haptic_rendering/Vertex_snap.h>
#include <haptic_sculpt/haptic_rendering/Virtual_mass.h>

#include <optional>

namespace haptic_sculpt {

/// How any loop runs, whatever its device gives.
struct Loop_parameters {
  double tick = 0.001;                  ///< s
  double delay = 0;                     ///< from a command to its force, ticks
  Virtual_coupling coupling;            ///< between hand and tool; refused where it is not passive
  Vertex_snap snap;                     ///< of a hand that holds no vertex; off by default
  Force_limits limits;                  ///< of what reaches the hand
  Virtual_mass_parameters virtual_mass; ///< of what is grabbed; off by default
  /// The most that the passivity controller may damp, N s/m; 0: there is none. Nothing: half of what may be asked for.
  std::optional<double> controller_damping;
  double reach = 0.001; ///< of a grab, m in the device
  /// For which the button has to be quiet before its next change counts, s: contacts bounce. 0: all changes count.
  double button_quiet_time = Debounced_button::default_quiet_time;
  std::size_t work_limit = 400; ///< pairs a drag may decide (doc/use/work.md)
  /// Pairs more for each face about the vertex in hand, up to most_work_of_faces or one a face.
  std::size_t work_of_a_face = 4;
  static constexpr std::size_t most_work_of_faces = 1024; ///< pairs; some 0.3 ms
};

} // namespace haptic_sculpt
