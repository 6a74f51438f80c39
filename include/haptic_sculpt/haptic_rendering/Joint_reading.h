// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace haptic_sculpt {

/// What a device of joints (JointDevice) says at a tick.
struct Joint_reading {
  Eigen::Vector3d theta = Eigen::Vector3d::Zero();  ///< joint angles as the encoders tell, rad
  Eigen::Vector3d torque = Eigen::Vector3d::Zero(); ///< of the motors, N m, where they are measured; else 0
  int button = 0;                                   ///< 0: none, 1: grab or create, 2: remove
  /// Since the last reading, s, by a clock. Does not count at the very first; after a restart a stall does.
  double elapsed = 0;
};

} // namespace haptic_sculpt
