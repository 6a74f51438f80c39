// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "batches.h"

#include <haptic_sculpt/sculpting/paper_1997/Six_list_broad_phase.h>
#include <haptic_sculpt/surface/broad_phase/Box_tree_broad_phase.h>
#include <haptic_sculpt/surface/broad_phase/Brute_force_broad_phase.h>

#include <string>

namespace haptic_sculpt::robustness {

/// \param name box_tree, six_lists or all_faces
inline Broad_phase_choice broad_phase_named(const std::string& name) {
  if (name == "six_lists")
    return {drag_batch<Six_list_broad_phase<Mesh>>, edit_batch<Six_list_broad_phase<Mesh>>};
  if (name == "all_faces")
    return {drag_batch<Brute_force_broad_phase<Mesh>>, edit_batch<Brute_force_broad_phase<Mesh>>};
  return {drag_batch<Box_tree_broad_phase<Mesh>>, edit_batch<Box_tree_broad_phase<Mesh>>};
}

inline std::vector<Broad_phase_choice> broad_phases_named(const std::vector<std::string>& names) {
  std::vector<Broad_phase_choice> choices;
  for (const std::string& name : names)
    choices.push_back(broad_phase_named(name));
  return choices;
}

} // namespace haptic_sculpt::robustness
