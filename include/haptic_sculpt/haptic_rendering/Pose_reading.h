// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace haptic_sculpt {

/// What a device of pose and force (PoseDevice) says at a tick.
struct Pose_reading {
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< of the handle, m, in axes of the device
  int button = 0;                                     ///< 0: none, 1: grab or create, 2: remove
  /// Since the last reading, s, by a clock. Does not count at the very first; after a restart a stall does.
  double elapsed = 0;
};

} // namespace haptic_sculpt
