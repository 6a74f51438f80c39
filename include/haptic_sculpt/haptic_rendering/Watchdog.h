// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Joint_reading.h>
#include <haptic_sculpt/haptic_rendering/loop/require_number.h>

#include <cmath>
#include <limits>

namespace haptic_sculpt {

/// What makes a loop let go of the hand.
enum class Loop_fault {
  none,
  not_finite, ///< an angle, or a torque, is infinite or not a number
  jump,       ///< an angle has changed faster than any hand turns a joint: a lost count, a loose cable
  stall,      ///< the last tick is too long ago: what the device did meanwhile is not known
  singular,   ///< the pose has no usable Jacobian: forces cannot be rendered, and the branch may be lost
  torque,     ///< a motor gives more than its limit, or the mechanism's weight alone takes more
  log,        ///< what is done cannot be written down in time: the journal has overrun
  late,       ///< ticks take longer than what stiffness and damping were chosen for
  clock,      ///< the time since the last reading is not a time
  energy,     ///< the observer says that the device gives energy: something in or about it is not as it was taken to be
  error       ///< an exception in the tick; the loop's failure() has what it says
};

/// The word used in reports and by `--fault`.
inline const char* name_of(Loop_fault fault) {
  constexpr const char* names[] = {"none", "nan", "jump", "stall", "singular", "torque", "log",
                                   "late", "clock", "energy", "error"};
  return names[static_cast<int>(fault)];
}

/// Bounds beyond which a reading is a fault.
struct Watchdog_limits {
  static constexpr double longest_stall = 10;    ///< s, the most that stall_time may be
  static constexpr double shortest_stall = 1e-4; ///< s, the least: any system pauses for as long
  static constexpr double least_rate = 1e-3;     ///< per s, of joint_rate: slower than any hand, so that a 0 is refused

  double joint_rate = 100;     ///< rad/s; a hand at 0.3 m/s turns no joint faster than 15 at cond(J) <= 10
  double stall_time = 0.02;    ///< s between two ticks; a device has to let go by itself about then
  double condition = 200;      ///< cond(J); forces have faded to 0 long before
  double torque_margin = 1.05; ///< times the limit of a motor, for what a sensor is off
  double late_ticks = 1.5;     ///< running mean of the time between two ticks, in ticks; infinite: any

  /// \throw Error naming what cannot be used
  void check() const {
    constexpr double none = std::numeric_limits<double>::infinity();
    internal::require_number("Watchdog_limits::joint_rate, the rate that is a jump,", "per s", joint_rate, least_rate,
                             none);
    internal::require_number("Watchdog_limits::stall_time, the time that is a stall,", "s", stall_time, shortest_stall,
                             longest_stall);
    internal::require_number("Watchdog_limits::condition, cond(J) that is singular,", "", condition, 1, 1e12);
    internal::require_number("Watchdog_limits::torque_margin, the margin of the torques,", "", torque_margin, 1, none);
    internal::require_number("Watchdog_limits::late_ticks, the mean that is late,", "ticks", late_ticks, 1, none);
  }
};

/// Looks at each reading before it is used. The first fault stays.
class Watchdog {
public:
  /// \param tick s \param torque_limit of a motor, N m; may be infinite
  /// \throw Error for limits that cannot be used
  Watchdog(const Watchdog_limits& limits, double tick, double torque_limit)
      : limits_(limits), tick_(tick), torque_limit_(torque_limit) {
    limits.check();
  }

  Loop_fault fault() const { return fault_; } ///< the first one since the last reset()
  const Watchdog_limits& limits() const { return limits_; } ///< those that were given
  /// A fault that was found elsewhere; ignored where there is one already.
  void report(Loop_fault fault) { fault_ = fault_ == Loop_fault::none ? fault : fault_; }
  /// After a fault has been seen to; the next angles are taken as they are, whenever they come.
  void reset() { fault_ = Loop_fault::none, has_last_ = false, mean_ = 1; }

  /// \return whether the reading may be used
  bool check(const Joint_reading& reading) { return check(reading.theta, reading.torque, reading.elapsed); }
  /// The same of any device. \param coordinates of what moves, rad or m \param elapsed since the last ones, s; does not
  /// count at the first
  bool check(const Eigen::Vector3d& coordinates, const Eigen::Vector3d& torque, double elapsed) {
    if (!coordinates.allFinite() || !torque.allFinite())
      report(Loop_fault::not_finite);
    else if (has_last_)
      compare(coordinates, elapsed);
    if (torque.cwiseAbs().maxCoeff() > limits_.torque_margin * torque_limit_)
      report(Loop_fault::torque);
    if (fault_ != Loop_fault::none)
      return false;
    last_ = coordinates, has_last_ = true;
    return true;
  }

  /// \return whether the pose may be used
  bool check_condition(double condition) {
    if (!(condition <= limits_.condition))
      report(Loop_fault::singular);
    return fault_ == Loop_fault::none;
  }

private:
  Watchdog_limits limits_;
  double tick_, torque_limit_;
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero();
  bool has_last_ = false;
  double mean_ = 1; ///< running mean of the time between two readings, ticks
  Loop_fault fault_ = Loop_fault::none;

  /// Ticks over which the mean runs: ticks of ten times the time are seen in the fourth, and one stall of twenty times
  /// it alone is none.
  static constexpr double memory = 64, longest = 20; ///< ticks; so much of one reading counts
  /// s: no device is read twice within it, and a step over much less would be no velocity any more.
  static constexpr double shortest = 1e-9;

  void compare(const Eigen::Vector3d& coordinates, double elapsed) {
    if (!(elapsed >= shortest) || !std::isfinite(elapsed)) {
      report(Loop_fault::clock);
      return;
    }
    mean_ += (std::fmin(elapsed / tick_, longest) - mean_) / memory;
    if (elapsed > limits_.stall_time)
      report(Loop_fault::stall);
    else if ((coordinates - last_).cwiseAbs().maxCoeff() > limits_.joint_rate * std::fmax(elapsed, tick_))
      report(Loop_fault::jump);
    else if (mean_ > limits_.late_ticks)
      report(Loop_fault::late);
  }
};

} // namespace haptic_sculpt
