// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Force_limit.h>
#include <haptic_sculpt/haptic_rendering/Refusal_burst.h>
#include <haptic_sculpt/haptic_rendering/Velocity_estimate.h>

namespace haptic_sculpt {

/// From the force that is wanted to the one that a hand may feel, in axes of the device: clamp, slew limit, burst,
/// ramp; after a fault a share that fades. No allocation.
///
/// The slew limit is for what the *proxy* did: where it falls off an edge the force changes within milliseconds. What
/// the hand's own way makes of the coupling comes at once, or the spring would be late, and a spring that is late gives
/// energy: k |step| of the spring, and 2 pi f b |step| of the damper, whose velocity is behind a low-pass of f Hz.
class Force_chain {
public:
  /// Begins at a force of 0. \param tick s \throw Error for limits or a coupling that cannot be used
  Force_chain(const Force_limits& limits, const Virtual_coupling& coupling, double tick)
      : limits_(limits), tick_(tick), burst_(checked(tick)), change_of_way_(change_of_way(coupling)) {
    limits.check(), coupling.check();
  }

  /// The force of this tick, N; once a tick. \param wanted N \param way of the handle since the last tick, m
  /// \param elapsed since then, s: of what is more than a tick the slew limit counts one
  Eigen::Vector3d follow(const Eigen::Vector3d& wanted, double way, double elapsed) {
    ramp_ = next_ramp();
    const double change = limits_.slew * std::fmin(tick_, elapsed) + change_of_way_ * way;
    const Eigen::Vector3d& followed = slew_.follow(clamped(wanted, limits_.largest), change);
    return ramp_ * clamped(followed + burst_.next(), limits_.largest);
  }
  /// The share of the last force that is left, one tick after a fault later. \param elapsed s; at least a tick counts
  double fade(double elapsed) { return fade_.next(std::fmax(tick_, elapsed) / limits_.fade_time); }
  double left() const { return fade_.share(); }      ///< that share in the last tick; 1 without a fault
  bool has_faded() const { return fade_.is_over(); } ///< the share has come to 0

  /// A share of the last force is what the next one follows: no more has come to the hand. Bursts go on.
  void cut_to(double share) { slew_.cut_to(share); }

  /// A refused edit is felt. \param direction in axes of the device \param mobility of the free handle there, 1/kg
  void refuse(const Eigen::Vector3d& direction, double mobility) { burst_.begin(direction, mobility); }
  void cut_burst() { burst_.cut(); } ///< what is left of one is not felt
  /// Forces begin at 0 and come back slowly.
  void restart() { ramp_ = 0, fade_.reset(), slew_.reset(), burst_.cut(); }

  /// The share of the force in the next tick: 0 to 1, from the last start on.
  double next_ramp() const { return std::fmin(1.0, ramp_ + tick_ / limits_.ramp_time); }
  const Force_limits& limits() const { return limits_; } ///< those that were given
  double tick() const { return tick_; }                  ///< s

private:
  Force_limits limits_;
  double tick_, ramp_ = 0;
  Fade_out fade_;
  Slew_limit slew_;
  Refusal_burst burst_;
  double change_of_way_; ///< N/m

  static double change_of_way(const Virtual_coupling& coupling) {
    return coupling.stiffness + Velocity_estimate::change_of_way(coupling.damping);
  }
  static double checked(double tick) {
    internal::require_number("the tick of a chain of forces", "s", tick, least_tick, most_tick);
    return tick;
  }

public:
  static constexpr double least_tick = 1e-5, ///< s; 100 kHz
      most_tick = 0.0125;                    ///< s: beyond it the burst cannot be made
};

} // namespace haptic_sculpt
