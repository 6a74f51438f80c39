// SPDX-License-Identifier: GPL-3.0-or-later
// For the reference only: what is asked of a template parameter. It is not compiled.

/// The concept of a device that says where its handle is and takes a force: what haptic_sculpt::Pose_loop runs on. A
/// driver with kinematics of its own models it; so does a mouse, whose `write_force` does nothing
/// (haptic_sculpt::Pose_loop_parameters::without_force()). A device that has joints instead models JointDevice.
///
/// Both functions are called once a tick, in the thread of the loop. `write_force` does not wait, none throws. A device
/// that calls at a rate of its own calls haptic_sculpt::Pose_loop::tick() itself (doc/use/own_device.md).
class PoseDevice {
public:
  /// Where the handle is, m, in axes of the device; the button; the time since the last reading, s, by a clock.
  haptic_sculpt::Pose_reading read_pose();

  /// The force on the hand, N, in the same axes.
  void write_force(const Eigen::Vector3d& force);
};
