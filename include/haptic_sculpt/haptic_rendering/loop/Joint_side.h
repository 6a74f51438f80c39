// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Haptic_parameters.h>
#include <haptic_sculpt/haptic_rendering/Joint_reading.h>

namespace haptic_sculpt {

/// What a device of joints adds to a loop: pose and Jacobian, gravity, torques scaled into their limits. The model of
/// what Interaction asks of a side; Pose_side is the other one.
class Joint_side {
public:
  using Reading = Joint_reading; ///< what the device says

  /// \param start a pose near the first reading \throw Error for parameters that cannot be used
  Joint_side(const Device_parameters<double>& device, const Device_pose<double>& start,
             const Haptic_parameters& parameters)
      : handle_(device, start, parameters.tick)
      , renderer_(parameters.limits, parameters.stiffest(), parameters.gravity, parameters.tick,
                  parameters.follows_pose ? parameters.needed_friction() : 0) {}

  /// \name What a reading says
  ///@{
  static const Eigen::Vector3d& coordinates(const Reading& reading) { return reading.theta; } ///< rad
  static const Eigen::Vector3d& efforts(const Reading& reading) { return reading.torque; }    ///< as measured, N m
  ///@}

  /// \return cond(J); infinite where there is no pose
  double follow(const Reading& reading, double elapsed) { return handle_.follow(reading.theta, elapsed); }
  const Eigen::Vector3d& position() const { return handle_.position(); }      ///< of the handle, m
  const Eigen::Vector3d& step() const { return handle_.step(); }              ///< of the handle since the last tick, m
  const Eigen::Vector3d& velocity() const { return handle_.velocity(); }      ///< of the handle, low-passed, m/s
  const Eigen::Vector3d& effort_step() const { return handle_.joint_step(); } ///< what efforts work on, rad

  /// \param wanted N \param way of the handle that made it, m \param elapsed since the last tick, s
  /// \param is_touched whether something pushes, or a snap pulls
  const Rendered_force& render(const Eigen::Vector3d& wanted, double way, double elapsed, bool is_touched) {
    return renderer_.render(handle_, wanted, way, elapsed, is_touched);
  }
  double next_ramp() const { return renderer_.next_ramp(); } ///< share of the force since the start, in the next tick
  Rendered_force fade_out(double elapsed) { return renderer_.fade_out(elapsed); } ///< after a fault
  bool has_faded() const { return renderer_.has_faded(); }                        ///< to nothing
  /// A refused edit is felt along a direction.
  void refuse(const Eigen::Vector3d& direction) { renderer_.refuse(handle_, direction); }
  void cut_burst() { renderer_.cut_burst(); } ///< what is left of that is not felt
  /// Forces begin at 0; no step leads to the next reading.
  void restart() { handle_.restart(), renderer_.restart(); }

  /// \name The device
  ///@{
  double effort_limit() const { return handle_.parameters().torque_limit(); } ///< of a motor, N m
  double friction() const { return handle_.parameters().viscous_friction(); } ///< against effort_step(), N m s/rad
  double resolution() const { return handle_.parameters().encoder_step(); }   ///< rad; 0: exact
  bool has_force() const { return true; }                                     ///< motors render
  ///@}
  const Handle_motion& handle() const { return handle_; } ///< where the handle was in the last tick

private:
  Handle_motion handle_;
  Force_renderer renderer_;
};

} // namespace haptic_sculpt
