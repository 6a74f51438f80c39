// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/conditioning.h>
#include <haptic_sculpt/device/forward_kinematics.h>
#include <haptic_sculpt/device/general_inverse.h>

#include <cmath>

namespace haptic_sculpt {

/// The pose in the middle of the joint limits, where a device is said to be at home. Failures as of
/// forward_kinematics().
inline Outcome<Device_pose<double>> home_pose(const Device_parameters<double>& parameters) {
  return forward_kinematics(parameters,
                            Device_vector<double>((parameters.least_angle() + parameters.greatest_angle()) / 2));
}

namespace internal {

/// How finely a workspace is gone through, m: else that of arms of metres would take minutes.
inline double step_through_workspace(const Device_parameters<double>& parameters) {
  constexpr double finest = 1e-3;       // m
  constexpr double share_of_arm = 1e-3; // of arms longer than a metre
  const Device_description<double>& lengths = parameters.description();
  return std::fmax(finest, share_of_arm * (lengths.primary_length + lengths.secondary_length));
}

} // namespace internal

/// The pose, of either form, with the handle at `position`, reached from `start` on a straight line through regular
/// poses.
///
/// Newton's method on the position in steps of at most a millimetre (of arms longer than 1 m, a thousandth of them), to
/// 1e-12 m. Failures: those of the kinematics on the way; `not_finite` for such a position, or one so far that the
/// steps overflow; `unreachable` where the way leaves the joint limits or cond(J) exceeds `most_condition`, or no step
/// comes nearer; shortfall the distance left, m.
inline Outcome<Device_pose<double>> reach_position(const Device_parameters<double>& parameters,
                                                   const Device_pose<double>& start,
                                                   const Device_vector<double>& position, double most_condition = 50) {
  using Result = Outcome<Device_pose<double>>;
  constexpr double precision = 1e-12;
  const double longest_step = internal::step_through_workspace(parameters);
  Device_pose<double> pose = start;
  const Device_vector<double> way = position - start.position;
  // No integer: of a place far off there are more than these hold, and few are taken.
  const double steps = 1 + std::floor(way.stableNorm() / longest_step);
  if (!way.allFinite() || !std::isfinite(steps)) // Eigen's norms may pass over what is no number
    return Result(Device_status::not_finite, 0.0);
  for (double k = 1; k <= steps; ++k) {
    const Device_vector<double> aim = start.position + way * (k / steps);
    for (int iteration = 0;; ++iteration) {
      const auto map = jacobian(parameters, pose); // asked of every pose, also of the one that is returned
      if (!map || !(translation_conditioning(*map).condition <= most_condition))
        return Result(Device_status::unreachable, (position - pose.position).stableNorm());
      if (iteration == 20 || !((aim - pose.position).norm() > precision))
        break;
      const Device_vector<double> turn = map->linear.partialPivLu().solve(aim - pose.position);
      const auto next = forward_kinematics(parameters, Device_vector<double>(pose.theta + turn), pose);
      if (!next)
        return Result(next.status(), (position - pose.position).stableNorm());
      pose = *next;
    }
    if ((aim - pose.position).norm() > precision || !within_joint_limits(parameters, pose.theta))
      return Result(Device_status::unreachable, (position - pose.position).stableNorm());
  }
  return pose;
}

/// The radius of the largest ball about the handle's place at `home` in which a straight way leads to poses with
/// cond(J) of at most `most_condition` within the joint limits; tried in 200 directions, in steps as above.
inline double workspace_radius(const Device_parameters<double>& parameters, const Device_pose<double>& home,
                               double most_condition = 10) {
  constexpr int directions = 200;
  const double step = internal::step_through_workspace(parameters);
  constexpr double golden_angle = 2.39996322972865332; // radians: spreads directions evenly over the sphere
  double radius = std::numeric_limits<double>::infinity();
  for (int k = 0; k < directions; ++k) {
    const double z = 1 - (2.0 * k + 1) / directions, ring = std::sqrt(1 - z * z);
    const Device_vector<double> direction(ring * std::cos(golden_angle * k), ring * std::sin(golden_angle * k), z);
    Device_pose<double> pose = home;
    double reached = 0;
    while (reached + step <= radius) {
      const auto next = reach_position(
          parameters, pose, Device_vector<double>(home.position + (reached + step) * direction), most_condition);
      if (!next)
        break;
      pose = *next, reached += step;
    }
    radius = std::fmin(radius, reached);
  }
  return radius;
}

} // namespace haptic_sculpt
