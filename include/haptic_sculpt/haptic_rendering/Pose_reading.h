// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace haptic_sculpt {

/// What a device of pose and force (PoseDevice) says at a tick.
struct Pose_reading {
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< of the handle, m, in axes of the device
  int button = 0;                                     ///< 0: none, 1: grab or create, 2: remove
  double elapsed = 0; ///< since the last reading, s, by a clock; does not count at the first
};

} // namespace haptic_sculpt
