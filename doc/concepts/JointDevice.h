// SPDX-License-Identifier: GPL-3.0-or-later
// For the reference only: what is asked of a template parameter. It is not compiled.

/// The concept of a device that says its joint angles and takes torques: what haptic_sculpt::Haptic_loop runs on, which
/// knows its kinematics (haptic_sculpt::Device_parameters). Has the model haptic_sculpt::Simulated_device. A device
/// that says where its handle is models PoseDevice.
///
/// Both functions are called once a tick, in the thread of the loop. `write` does not wait, none throws.
class JointDevice {
public:
  /// The joint angles as the encoders tell, rad; the button; the time since the last reading, s, by a clock; torques where they are
  /// measured, N m.
  haptic_sculpt::Joint_reading read();

  /// The torques of the motors, N m.
  void write(const Eigen::Vector3d& torque);
};
