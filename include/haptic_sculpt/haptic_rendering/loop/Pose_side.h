// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Haptic_parameters.h>
#include <haptic_sculpt/haptic_rendering/Pose_reading.h>

namespace haptic_sculpt {

/// What a device of pose and force does at its handle.
class Pose_device {
public:
  double friction;       ///< dissipated at the handle, N s/m; nobody else knows it, so it has no default
  double mass = 0.05;    ///< of the free handle, kg
  double resolution = 0; ///< of a position, m; 0: exact

  /// \param friction N s/m
  explicit Pose_device(double friction) : friction(friction) {}
  /// A device that gives no force, such as a mouse.
  static Pose_device without_force() {
    Pose_device device(0);
    device.has_force_ = false;
    return device;
  }
  bool has_force() const { return has_force_; } ///< false: it is without_force()

  /// \throw Error naming what no device has
  void check() const {
    internal::require_number("Pose_device::friction", "N s/m", friction, 0, 1e5);
    internal::require_number("Pose_device::mass, that of the handle,", "kg", mass, 1e-4, 100);
    internal::require_number("Pose_device::resolution", "m", resolution, 0, 0.01);
  }

private:
  bool has_force_ = true;
};

/// A loop's side towards a device of pose and force (Interaction; Joint_side is the one of joints).
class Pose_side {
public:
  using Reading = Pose_reading; ///< what the device says

  /// \throw Error for parameters that cannot be used
  Pose_side(const Pose_device& device, const Haptic_parameters& parameters)
      : device_(device)
      , chain_(parameters.limits, parameters.stiffest(), parameters.tick)
      , velocity_(parameters.tick) {
    device.check();
  }

  /// \name What a reading says
  ///@{
  static const Eigen::Vector3d& coordinates(const Reading& reading) { return reading.position; } ///< m
  static Eigen::Vector3d efforts(const Reading&) { return Eigen::Vector3d::Zero(); }             ///< not measured
  ///@}

  /// \return 1: every place is as good as any
  double follow(const Reading& reading, double elapsed) {
    step_ = is_first_ ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : Eigen::Vector3d(reading.position - position_);
    velocity_.add(step_, is_first_ ? chain_.tick() : elapsed);
    position_ = reading.position, is_first_ = false;
    return 1;
  }
  const Eigen::Vector3d& position() const { return position_; }            ///< of the handle, m
  const Eigen::Vector3d& step() const { return step_; }                    ///< of the handle since the last tick, m
  const Eigen::Vector3d& velocity() const { return velocity_.value(); }    ///< of the handle, low-passed, m/s
  const Eigen::Vector3d& effort_step() const { return step_; }             ///< what efforts work on, m

  /// \param wanted N \param way of the handle that made it, m \param elapsed since the last tick, s
  const Rendered_force& render(const Eigen::Vector3d& wanted, double way, double elapsed, bool /*is_touched*/) {
    last_.force = last_.interaction_torque = chain_.follow(wanted, way, elapsed);
    if (!last_.force.allFinite())
      last_ = Rendered_force(), last_.is_finite = false;
    return last_;
  }
  double next_ramp() const { return chain_.next_ramp(); } ///< share of the force since the start, in the next tick
  /// After a fault.
  Rendered_force fade_out(double elapsed) {
    Rendered_force faded = last_;
    faded.force *= chain_.fade(elapsed);
    faded.interaction_torque = faded.force;
    return faded;
  }
  bool has_faded() const { return chain_.has_faded(); } ///< to nothing
  /// A refused edit is felt along a direction.
  void refuse(const Eigen::Vector3d& direction) { chain_.refuse(direction, 1 / device_.mass); }
  void cut_burst() { chain_.cut_burst(); } ///< what is left of that is not felt
  /// Forces begin at 0; no step leads to the next reading.
  void restart() { is_first_ = true, velocity_.reset(), chain_.restart(), last_ = Rendered_force(); }

  /// \name The device
  ///@{
  double effort_limit() const { return std::numeric_limits<double>::infinity(); } ///< not known
  double friction() const { return device_.friction; }                            ///< against effort_step(), N s/m
  double resolution() const { return device_.resolution; }                        ///< m; 0: exact
  bool has_force() const { return device_.has_force(); }                          ///< a mouse has none
  ///@}

private:
  Pose_device device_;
  Force_chain chain_;
  Velocity_estimate velocity_;
  Rendered_force last_;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero(), step_ = Eigen::Vector3d::Zero();
  bool is_first_ = true;
};

} // namespace haptic_sculpt
