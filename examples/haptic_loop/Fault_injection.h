// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Settings.h"

#include <haptic_sculpt/device/conditioning.h>
#include <haptic_sculpt/device/forward_kinematics.h>
#include <haptic_sculpt/haptic_rendering/Joint_reading.h>
#include <haptic_sculpt/haptic_rendering/Watchdog.h>

#include <limits>

namespace haptic_sculpt::loop_program {

/// Makes readings go wrong from a time on, in the way that a device would.
class Fault_injection {
public:
  Fault_injection(const std::optional<Injected_fault>& fault, const Device_parameters<double>& parameters, double tick)
      : fault_(fault), parameters_(parameters), tick_(tick) {}

  bool is_due(double time) const { return fault_ && time >= fault_->time; }
  bool is_log() const { return fault_ && fault_->kind == Loop_fault::log; }
  bool is_stall() const { return fault_ && fault_->kind == Loop_fault::stall; }
  bool has_begun() const { return has_begun_; }
  void begin() { has_begun_ = true; }

  /// \param pose where the mechanism is
  void spoil(Joint_reading& reading, const Device_pose<double>& pose) {
    switch (fault_->kind) {
    case Loop_fault::not_finite:
      reading.theta[0] = std::numeric_limits<double>::quiet_NaN();
      break;
    case Loop_fault::jump:
      reading.theta[1] += 2 * Watchdog_limits().joint_rate * std::fmax(reading.elapsed, tick_);
      break;
    case Loop_fault::torque:
      reading.torque[0] = 2 * parameters_.torque_limit();
      break;
    case Loop_fault::singular: // encoders drift, slowly enough for joints, to where the mechanism is singular
      if (!has_begun_)
        drift_ = way_to_singular(pose);
      drifted_ += drift_rate * tick_;
      reading.theta += std::fmin(drifted_, drift_.norm()) * drift_.normalized();
      break;
    default:
      break;
    }
    has_begun_ = true;
  }

private:
  static constexpr double drift_rate = 20; ///< rad/s
  std::optional<Injected_fault> fault_;
  Device_parameters<double> parameters_;
  double tick_, drifted_ = 0;
  bool has_begun_ = false;
  Eigen::Vector3d drift_ = Eigen::Vector3d::UnitX();

  /// The shortest of 26 ways to joint angles that have no usable pose.
  Eigen::Vector3d way_to_singular(const Device_pose<double>& pose) const {
    Eigen::Vector3d shortest = 4 * Eigen::Vector3d::UnitX();
    for (int i = 0; i < 27; ++i) {
      const Eigen::Vector3d way(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (i == 13)
        continue;
      const Eigen::Vector3d direction = way.normalized();
      Device_pose<double> at = pose;
      for (double s = 0.01; s < shortest.norm(); s += 0.01) {
        const auto next = forward_kinematics(parameters_, Eigen::Vector3d(pose.theta + s * direction), at);
        const auto map = next ? jacobian(parameters_, *next) : Outcome<Device_jacobian<double>>();
        if (!next || !map || !(translation_conditioning(*map).condition < 1000)) {
          shortest = (s + 0.02) * direction;
          break;
        }
        at = *next;
      }
    }
    return shortest;
  }
};

} // namespace haptic_sculpt::loop_program
