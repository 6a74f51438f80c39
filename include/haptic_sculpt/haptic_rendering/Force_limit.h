// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Virtual_coupling.h>

#include <algorithm>
#include <cmath>

namespace haptic_sculpt {

/// What may reach the hand.
struct Force_limits {
  double largest = 5;         ///< norm of the force, N
  double slew = 300;          ///< its change, N/s, beside what the hand's own way changes: Force_chain
  double full_condition = 10; ///< cond(J) up to which the whole force is rendered
  /// cond(J) from which nothing is: encoder steps turn the force by degrees there. Where it is full_condition, the
  /// force of a touch ends at once as the hand comes there.
  double no_condition = 20;
  double ramp_time = 0.3;     ///< from 0 to the whole force after a start, s
  double fade_time = 0.1;     ///< to 0 on a fault, s

  /// \throw Error naming what cannot be used
  void check() const {
    internal::require_number("Force_limits::largest, the largest force,", "N", largest, 0, 1e9);
    internal::require_number("Force_limits::slew, the slew limit,", "N/s", slew, 1e-3, 1e12);
    internal::require_number("Force_limits::full_condition, cond(J) of the whole force,", "", full_condition, 1, 1e12);
    internal::require_number("Force_limits::no_condition, of no force,", "", no_condition, full_condition, 1e12);
    internal::require_number("Force_limits::ramp_time, the ramp's time,", "s", ramp_time, 0, 60);
    internal::require_number("Force_limits::fade_time, the time to fade,", "s", fade_time, 0, 60);
  }
};

/// The share of the force that is rendered at a pose: 1 to 0, linear in cond(J).
inline double fading_by_condition(const Force_limits& limits, double condition) {
  if (!(condition < limits.no_condition))
    return 0;
  return condition <= limits.full_condition
             ? 1
             : (limits.no_condition - condition) / (limits.no_condition - limits.full_condition);
}

/// A force of at most the given norm, in the same direction.
inline Eigen::Vector3d clamped(const Eigen::Vector3d& force, double largest) {
  const double norm = force.norm();
  return norm > largest ? Eigen::Vector3d(force * (largest / norm)) : force;
}

/// Follows a force at a bounded rate. Reaches it exactly, so that a force of 0 becomes 0.
class Slew_limit {
public:
  /// \param step the largest change in a tick, N
  const Eigen::Vector3d& follow(const Eigen::Vector3d& force, double step) {
    const Eigen::Vector3d change = force - value_;
    const double norm = change.norm();
    value_ = norm <= step ? force : Eigen::Vector3d(value_ + change * (step / norm));
    return value_;
  }
  const Eigen::Vector3d& value() const { return value_; } ///< the force followed last, N
  void reset() { value_.setZero(); }                      ///< to 0 at once, whatever the rate
  /// To a share of it at once.
  void cut_to(double share) { value_ *= share; }

private:
  Eigen::Vector3d value_ = Eigen::Vector3d::Zero();
};

/// What is left of a force after a fault: a share that goes from 1 to exactly 0 in equal steps.
class Fade_out {
public:
  /// The share in the next tick. \param part of the time to fade that a tick takes
  double next(double part) {
    share_ = std::fmax(0.0, share_ - part);
    if (share_ < least_share)
      share_ = 0;
    return share_;
  }
  double share() const { return share_; }      ///< the one that next() gave last; 1 before
  bool is_over() const { return share_ == 0; } ///< the share is exactly 0, until reset()
  void reset() { share_ = 1; }                 ///< the share is 1 again

private:
  /// Of the force, no unit: less is nothing but what sums of rounded steps leave.
  static constexpr double least_share = 1e-9;

  double share_ = 1;
};

/// The largest share, at most 1, of `torque` that all three motors can add to `carried`, N m: 0 where that alone is too
/// much for one of them. One share for all three keeps the direction of the force; clipping each motor by itself turns
/// it by 20 to 30 degrees.
inline double share_in_room(const Eigen::Vector3d& torque, const Eigen::Vector3d& carried, double limit) {
  double share = 1;
  for (int joint = 0; joint < 3; ++joint) {
    const double room = torque[joint] > 0 ? limit - carried[joint] : limit + carried[joint];
    const double wanted = std::abs(torque[joint]);
    if (wanted > room)
      share = std::min(share, std::max(0.0, room / wanted));
  }
  return share;
}

} // namespace haptic_sculpt
