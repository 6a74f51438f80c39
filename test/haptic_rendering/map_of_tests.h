// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Workspace_map.h>

namespace haptic_rendering_tests {

/// Turned, moved and enlarged, so that a frame or a scale that was forgotten is seen.
inline const haptic_sculpt::Workspace_map map_of_tests(20, Eigen::Vector3d(0.3, -0.2, 0.9),
                                                       Eigen::Vector3d(0.5, 0.5, 0.5), Eigen::Vector3d(0, 0, 0.132));

} // namespace haptic_rendering_tests
