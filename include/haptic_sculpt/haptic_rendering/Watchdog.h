// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_WATCHDOG_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_WATCHDOG_H

#include <haptic_sculpt/haptic_rendering/Joint_reading.h>

namespace haptic_sculpt {

/// What makes a loop let go of the hand.
enum class Loop_fault {
  none,
  not_finite, ///< an angle, or a torque, is infinite or not a number
  jump,       ///< an angle has changed faster than any hand turns a joint: a lost count, a loose cable
  stall,      ///< the last tick is too long ago: what the device did meanwhile is not known
  singular,   ///< the pose has no usable Jacobian: forces cannot be rendered, and the branch may be lost
  torque,     ///< a motor gives more than its limit, or the mechanism's weight alone takes more
  log         ///< what is done cannot be written down in time: the journal has overrun
};

/// The word used in reports and by `--fault`.
inline const char* name_of(Loop_fault fault) {
  constexpr const char* names[] = {"none", "nan", "jump", "stall", "singular", "torque", "log"};
  return names[static_cast<int>(fault)];
}

/// Bounds beyond which a reading is a fault.
struct Watchdog_limits {
  double joint_rate = 100;     ///< rad/s; a hand at 0.3 m/s turns no joint faster than 15 at cond(J) <= 10
  double stall_time = 0.02;    ///< s between two ticks; a device has to let go by itself about then
  double condition = 200;      ///< cond(J); forces have faded to 0 long before
  double torque_margin = 1.05; ///< times the limit of a motor, for what a sensor is off
};

/// Looks at each reading before it is used. The first fault stays.
class Watchdog {
public:
  /// \param tick s \param torque_limit of a motor, N m; may be infinite
  Watchdog(const Watchdog_limits& limits, double tick, double torque_limit)
      : limits_(limits), tick_(tick), torque_limit_(torque_limit) {}

  Loop_fault fault() const { return fault_; } ///< the first one since the last reset()
  /// A fault that was found elsewhere; ignored where there is one already.
  void report(Loop_fault fault) { fault_ = fault_ == Loop_fault::none ? fault : fault_; }
  /// After a fault has been seen to; the next angles are taken as they are.
  void reset() { fault_ = Loop_fault::none, has_last_ = false; }

  /// \return whether the reading may be used
  bool check(const Joint_reading& reading) {
    if (!reading.theta.allFinite() || !reading.torque.allFinite())
      report(Loop_fault::not_finite);
    else if (!(reading.elapsed <= limits_.stall_time))
      report(Loop_fault::stall);
    else if (has_last_ &&
             (reading.theta - last_).cwiseAbs().maxCoeff() > limits_.joint_rate * std::fmax(reading.elapsed, tick_))
      report(Loop_fault::jump);
    else if (reading.torque.cwiseAbs().maxCoeff() > limits_.torque_margin * torque_limit_)
      report(Loop_fault::torque);
    if (fault_ != Loop_fault::none)
      return false;
    last_ = reading.theta, has_last_ = true;
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
  Loop_fault fault_ = Loop_fault::none;
};

} // namespace haptic_sculpt

#endif
