// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/gravity_torque.h>
#include <haptic_sculpt/device/spatial_dynamics.h>
#include <haptic_sculpt/haptic_rendering/loop/Force_chain.h>
#include <haptic_sculpt/haptic_rendering/Handle_motion.h>

#include <utility>

namespace haptic_sculpt {

/// What carries the mechanism's weight, so that the hand need not.
enum class Gravity_compensation { none, spatial };

/// A force in axes of the device, N, and the torques of the motors, N m.
struct Rendered_force {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();              ///< on the hand, after every limit
  Eigen::Vector3d interaction_torque = Eigen::Vector3d::Zero(); ///< J^T force
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();             ///< with gravity compensation
  bool is_overloaded = false;                                   ///< the weight alone takes more than a motor may give
  bool is_finite = true; ///< false: what was asked for is no force, and none is given
};

/// From a wanted force to torques: the chain of all devices, fading by cond(J), gravity compensation, room of the
/// motors. No allocation.
///
/// While something is touched or a snap pulls, the share by the pose and what the motors had room for only fall: a
/// spring that is pressed where they are small and let go of where they are large would give energy that no hand has
/// put in.
class Force_renderer {
public:
  /// Begins at a force of 0. \param tick s \param friction that the coupling needs at the handle, N s/m: where the
  /// device has less the force is scaled down \throw Error for limits, a coupling or a tick that cannot be used
  Force_renderer(const Force_limits& limits, const Virtual_coupling& coupling, Gravity_compensation compensation,
                 double tick, double friction = 0)
      : chain_(limits, coupling, tick), compensation_(compensation), friction_(friction) {}

  /// The force and torques of this tick; once a tick. \param wanted N, in axes of the device
  const Rendered_force& render(const Handle_motion& handle, const Eigen::Vector3d& wanted) {
    return render(handle, wanted, handle.step().norm(), chain_.tick(), false);
  }
  /// \param way of the handle that made it what it is, m \param elapsed since the last tick, s \param is_touched
  /// whether something pushes, or a snap pulls
  const Rendered_force& render(const Handle_motion& handle, const Eigen::Vector3d& wanted, double way, double elapsed,
                               bool is_touched) {
    const double share = share_at(handle);
    if (!is_touched && std::exchange(was_touched_, false)) // what the hand has not felt does not come now
      chain_.cut_to(share > 0 ? std::fmin(1.0, felt_ / share) : 0), forget_touch();
    was_touched_ = is_touched;
    const Eigen::Vector3d force = chain_.follow(wanted, way, elapsed);
    carried_ = std::fmin(1.0, carried_ + chain_.tick() / chain_.limits().ramp_time);
    share_ = is_touched ? std::fmin(share_, share) : share;
    in_room(handle, clamped(force * share_, room_));
    felt_ = force.isZero(0) ? share_ : last_.force.norm() / force.norm();
    if (!last_.force.allFinite() || !last_.torque.allFinite())
      last_ = Rendered_force(), last_.is_finite = false;
    return last_;
  }

  /// After a fault: the last torques, less each tick, and 0 once the time to fade has passed. Uses nothing that a
  /// device says. \param elapsed since the last tick, s
  Rendered_force fade_out(double elapsed = 0) {
    const double share = chain_.fade(elapsed);
    Rendered_force faded = last_;
    faded.force *= share, faded.interaction_torque *= share, faded.torque *= share;
    return faded;
  }
  bool has_faded() const { return chain_.has_faded(); } ///< fade_out() has come to 0

  /// A refused edit is felt, the less the lighter the mechanism is there. \param direction in axes of the device
  void refuse(const Handle_motion& handle, const Eigen::Vector3d& direction) {
    chain_.refuse(direction, mobility(handle, direction.normalized()));
  }
  void cut_burst() { chain_.cut_burst(); } ///< what is left of one is not felt
  /// Forces begin at 0 and come back slowly; as slowly what carries the weight, from what the fade has left of it.
  void restart() {
    const double left = last_.is_finite ? chain_.left() : 0;
    const Eigen::Vector3d weight = left * (last_.torque - last_.interaction_torque);
    carried_ *= left;
    chain_.restart(), forget_touch(), last_ = Rendered_force();
    last_.torque = weight; // fades, where a fault comes next
  }

  double next_ramp() const { return chain_.next_ramp(); } ///< share of the force in the next tick
  const Force_limits& limits() const { return chain_.limits(); } ///< those that were given

private:
  Force_chain chain_;
  Gravity_compensation compensation_;
  double friction_;
  double carried_ = 1; ///< the share of the weight that the motors carry: all of it from the start on
  /// Since nothing was touched: the least share_at(), and the least force, N, for which motors had no more room.
  double share_ = 1, room_ = std::numeric_limits<double>::infinity();
  bool was_touched_ = false; ///< in the last tick
  double felt_ = 0;          ///< share of the last tick's force that came to the hand
  Rendered_force last_;

  void forget_touch() { share_ = 1, room_ = std::numeric_limits<double>::infinity(); }

  /// By cond(J), and by the friction that is left at the handle, as the coupling is passive with.
  double share_at(const Handle_motion& handle) const {
    const double fading = fading_by_condition(chain_.limits(), handle.condition());
    const double there = handle.parameters().viscous_friction() / (handle.greatest() * handle.greatest());
    return there < friction_ * fading ? there / friction_ : fading;
  }

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

  void in_room(const Handle_motion& handle, const Eigen::Vector3d& force) {
    const Eigen::Vector3d whole = weight_torque(handle), weight = carried_ * whole,
                          torque = handle.jacobian().linear.transpose() * force;
    const double limit = handle.parameters().torque_limit(), share = share_in_room(torque, weight, limit);
    last_.force = share * force;
    if (share < 1 && was_touched_)
      room_ = last_.force.norm();
    last_.interaction_torque = share * torque;
    last_.torque = (weight + last_.interaction_torque).cwiseMax(-limit).cwiseMin(limit);
    last_.is_overloaded = whole.cwiseAbs().maxCoeff() > limit, last_.is_finite = true;
  }

  Eigen::Vector3d weight_torque(const Handle_motion& handle) const {
    if (compensation_ == Gravity_compensation::spatial)
      return gravity_torque(handle.parameters(), handle.pose(), handle.jacobian());
    return Eigen::Vector3d::Zero();
  }
};

} // namespace haptic_sculpt
