// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_FORCE_RENDERER_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_FORCE_RENDERER_H

#include <haptic_sculpt/device/gravity_torque.h>
#include <haptic_sculpt/device/spatial_dynamics.h>
#include <haptic_sculpt/device/planar_dynamics.h>
#include <haptic_sculpt/haptic_rendering/Force_limit.h>
#include <haptic_sculpt/haptic_rendering/Handle_motion.h>
#include <haptic_sculpt/haptic_rendering/Refusal_burst.h>
#include <haptic_sculpt/haptic_rendering/Virtual_coupling.h>

namespace haptic_sculpt {

/// What carries the mechanism's weight, so that the hand need not.
enum class Gravity_compensation { none, spatial, planar };

/// A force in axes of the device, N, and the torques of the motors, N m.
struct Rendered_force {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();              ///< on the hand, after every limit
  Eigen::Vector3d interaction_torque = Eigen::Vector3d::Zero(); ///< J^T force
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();             ///< with gravity compensation
  bool is_overloaded = false;                                   ///< the weight alone takes more than a motor may give
};

/// From a wanted force to torques: slew limit, burst, clamp, fading by cond(J), ramp, gravity compensation, room of the
/// motors. No allocation.
class Force_renderer {
public:
  /// Begins at a force of 0. \param tick s
  Force_renderer(const Force_limits& limits, Gravity_compensation compensation, double tick)
      : limits_(limits), compensation_(compensation), tick_(tick), burst_(tick) {}

  /// The force and torques of this tick; once a tick. \param wanted N, in axes of the device
  Rendered_force render(const Handle_motion& handle, const Eigen::Vector3d& wanted) {
    ramp_ = std::fmin(1.0, ramp_ + tick_ / limits_.ramp_time);
    const Eigen::Vector3d followed = slew_.follow(clamped(wanted, limits_.largest), limits_.slew * tick_);
    const Eigen::Vector3d force = clamped(followed + burst_.next(), limits_.largest);
    return in_room(handle, force * (ramp_ * fading_by_condition(limits_, handle.condition())));
  }

  /// After a fault: the last torques, less each tick, and 0 once the time to fade has passed. Uses nothing that a
  /// device says.
  Rendered_force fade_out() {
    const double share = fade_.next(tick_ / limits_.fade_time);
    Rendered_force faded = last_;
    faded.force *= share, faded.interaction_torque *= share, faded.torque *= share;
    return faded;
  }
  bool has_faded() const { return fade_.is_over(); } ///< fade_out() has come to 0

  /// A refused edit is felt, the less the lighter the mechanism is there. \param direction in axes of the device
  void refuse(const Handle_motion& handle, const Eigen::Vector3d& direction) {
    burst_.begin(direction, mobility(handle, direction.normalized()));
  }
  /// Forces begin at 0 and come back slowly.
  void restart() { ramp_ = 0, fade_.reset(), slew_.reset(), burst_.cut(), last_ = Rendered_force(); }

  double ramp() const { return ramp_; }                  ///< share of the force since the last start, 0 to 1
  const Force_limits& limits() const { return limits_; } ///< those that were given

private:
  Force_limits limits_;
  Gravity_compensation compensation_;
  double tick_, ramp_ = 0;
  Fade_out fade_;
  Slew_limit slew_;
  Refusal_burst burst_;
  Rendered_force last_;

  /// How fast the free handle is accelerated by a newton along a direction, 1/kg; infinite where that is not known.
  static double mobility(const Handle_motion& handle, const Eigen::Vector3d& direction) {
    const auto motion =
        device_motion(handle.parameters(), handle.pose(), Device_vector<double>(Device_vector<double>::Zero()));
    if (!motion)
      return std::numeric_limits<double>::infinity();
    const Eigen::Matrix3d& linear = handle.jacobian().linear;
    const Device_vector<double> torque = linear.transpose() * direction;
    return (linear * spatial_dynamics(handle.parameters(), *motion).solve_mass(torque)).norm();
  }

  Rendered_force in_room(const Handle_motion& handle, const Eigen::Vector3d& force) {
    const Eigen::Vector3d weight = weight_torque(handle), torque = handle.jacobian().linear.transpose() * force;
    const double limit = handle.parameters().torque_limit(), share = share_in_room(torque, weight, limit);
    last_.force = share * force;
    last_.interaction_torque = share * torque;
    last_.torque = (weight + last_.interaction_torque).cwiseMax(-limit).cwiseMin(limit);
    last_.is_overloaded = weight.cwiseAbs().maxCoeff() > limit;
    return last_;
  }

  Eigen::Vector3d weight_torque(const Handle_motion& handle) const {
    if (compensation_ == Gravity_compensation::spatial)
      return gravity_torque(handle.parameters(), handle.pose(), handle.jacobian());
    if (compensation_ == Gravity_compensation::planar) {
      const auto motion =
          device_motion(handle.parameters(), handle.pose(), Device_vector<double>(Device_vector<double>::Zero()));
      if (motion)
        if (const auto terms = planar_dynamics(handle.parameters(), *motion); terms)
          return terms->gravity;
    }
    return Eigen::Vector3d::Zero();
  }
};

} // namespace haptic_sculpt

#endif
