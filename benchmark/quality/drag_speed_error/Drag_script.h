// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "drag_speed_error/Arithmetic.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace haptic_sculpt::benchmark {

/// One drag: of a vertex, towards a target.
struct Drag_step {
  std::size_t vertex;
  std::array<double, 3> target;
};

/// A mesh and drags, the same for every arithmetic. Meshes and steps are made from the seed.
struct Drag_script {
  std::string name;
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::size_t, 3>> faces;
  std::vector<Drag_step> steps;
};

/// What the drags of a script took, and what became of them. Each starts from an embedded mesh: one that has gone wrong
/// is counted and taken back.
struct Drag_counts {
  std::size_t drags = 0;
  std::size_t blocked = 0;           ///< not at the target at the end
  std::size_t wrongly_blocked = 0;   ///< of these, those to whose targets the straight way is free
  std::size_t crossed = 0;           ///< that touched something, or went through it, on the way
  std::size_t self_intersecting = 0; ///< of these, those that left a mesh that is not valid
  std::vector<double> nanoseconds;   ///< of each drag
};

/// Names of all scripts, and one of them with this many drags.
const std::vector<std::string>& drag_script_names();
Drag_script drag_script(const std::string& name, std::size_t drags, std::uint64_t seed);

/// Makes the drags; each is judged by GMP rationals over all faces. \param slides the response: slide, or else stop
Drag_counts measure_exact(const Drag_script& script, bool slides);
Drag_counts measure_rounded(const Drag_script& script, bool slides, Arithmetic arithmetic);

} // namespace haptic_sculpt::benchmark
