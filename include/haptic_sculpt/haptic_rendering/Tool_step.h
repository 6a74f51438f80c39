// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Virtual_coupling.h>
#include <haptic_sculpt/sculpting/Drag_result.h>

#include <optional>

namespace haptic_sculpt {

/// What the button has done in a tick.
enum class Tool_event { none, grabbed, created_on_face, created_on_edge, released, removed, refused };

/// Where the hand wants what it holds, and where that is.
struct Tool_step {
  Eigen::Vector3d target = Eigen::Vector3d::Zero(), ///< where the hand wants it, in the scene
      proxy = Eigen::Vector3d::Zero();              ///< where it is, in the scene
  bool reached = true;                              ///< the proxy is at the target: then the coupling has no force
  bool starved = false; ///< the drag was cut short before any contact was found: nothing is known to hold it
  std::optional<Drag_end> end;                      ///< none: nothing is held, and there is no probe
  std::size_t pairs = 0;                            ///< of the drag's work
  int contacts = 0;                                 ///< that hold it; 0 in free motion
  std::optional<std::uint64_t> obstacle; ///< of a vertex held: a vertex of what it touches, by its number that lasts
  Contact_span span;                     ///< of the contacts' pushes, in axes of the device
  Tool_event event = Tool_event::none;   ///< what the button did in this tick
};

/// What a button did, counted.
struct Tool_edits {
  std::size_t grabbed = 0, ///< vertices that were there
      created = 0,         ///< on faces and on edges; each is held at once, and not counted as grabbed
      removed = 0,         ///< by collapsing an edge
      released = 0,        ///< by letting the button go
      refused = 0;         ///< presses that changed nothing of the mesh
};

} // namespace haptic_sculpt
