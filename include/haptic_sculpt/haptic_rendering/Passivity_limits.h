// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_PASSIVITY_LIMITS_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_PASSIVITY_LIMITS_H

#include <haptic_sculpt/haptic_rendering/Force_limit.h>
#include <haptic_sculpt/haptic_rendering/Virtual_coupling.h>
#include <haptic_sculpt/haptic_rendering/reach_position.h>

#include <algorithm>
#include <random>
#include <vector>

namespace haptic_sculpt {

/// The largest stiffness, N/m, that cannot give energy to any hand: 2 (b_phys - |b|) / (T (1 + 2 d)).
/// \param friction b_phys, the least damping at the handle, N s/m \param damping b, N s/m \param tick T, s \param delay
/// d, ticks
inline double passive_stiffness(double friction, double damping, double tick, double delay) {
  return 2 * (friction - std::abs(damping)) / (tick * (1 + 2 * delay));
}

/// The largest stiffness, N/m, that was found stable in all hands: 0.6 of 2 (b_phys + b) / (T (1 + 2 d)).
inline double stable_stiffness(double friction, double damping, double tick, double delay) {
  return 0.6 * 2 * (friction + damping) / (tick * (1 + 2 * delay));
}

/// Where the device gives least friction to the handle, for what is rendered there.
struct Worst_pose {
  Device_pose<double> pose;
  double greatest = 0;   ///< sigma_max(J), m/rad
  double fading = 0;     ///< the share of the force that is rendered there
  bool is_found = false; ///< false: no pose of the workspace can be used

  /// b_phys at the handle, N s/m, in units of what is rendered.
  double friction(const Device_parameters<double>& parameters) const {
    return is_found ? parameters.viscous_friction() / (greatest * greatest * fading) : 0;
  }
};

namespace internal {

/// sigma_max^2 times the share that is rendered: what makes a pose bad. Negative where nothing is.
/// Poses with a knee on the other side than at `home` do not count: the way there leads through poses without any
/// force.
template <class Contains>
Worst_pose rated_pose(const Device_parameters<double>& parameters, const Device_pose<double>& home,
                      const Device_vector<double>& theta, const Force_limits& limits, const Contains& contains) {
  Worst_pose rated;
  if (!within_joint_limits(parameters, theta))
    return rated;
  const auto pose = forward_kinematics(parameters, theta);
  if (!pose || working_mode(parameters, *pose) != working_mode(parameters, home) || !contains(pose->position))
    return rated;
  const auto map = jacobian(parameters, *pose);
  if (!map)
    return rated;
  const auto conditioning = translation_conditioning(*map);
  rated = {*pose, conditioning.greatest, fading_by_condition(limits, conditioning.condition), true};
  rated.is_found = rated.fading > 0;
  return rated;
}

} // namespace internal

/// Searches the poses whose handle's place `contains(position)` for the worst: a grid of joint angles, and from its
/// worst a climb by random steps that get smaller. Allocates; some tenths of a second.
template <class Contains>
Worst_pose worst_pose(const Device_parameters<double>& parameters, const Force_limits& limits, const Contains& contains,
                      int per_joint = 25) {
  using V = Device_vector<double>;
  const auto badness = [](const Worst_pose& p) { return p.is_found ? p.greatest * p.greatest * p.fading : -1.0; };
  constexpr std::size_t starts = 24;
  std::vector<Worst_pose> worst;
  const auto home = home_pose(parameters);
  if (!home)
    return Worst_pose();
  const V span = parameters.greatest_angle() - parameters.least_angle();
  for (int i = 0; i < per_joint * per_joint * per_joint; ++i) {
    const V part(i % per_joint, i / per_joint % per_joint, i / per_joint / per_joint);
    const V theta = parameters.least_angle() + span.cwiseProduct(part / (per_joint - 1.0));
    const Worst_pose rated = internal::rated_pose(parameters, *home, theta, limits, contains);
    if (!rated.is_found)
      continue;
    worst.push_back(rated);
    std::sort(worst.begin(), worst.end(),
              [&](const Worst_pose& a, const Worst_pose& b) { return badness(a) > badness(b); });
    if (worst.size() > starts)
      worst.pop_back();
  }
  // At the edge of what counts, and on ridges, the axes lead nowhere: directions are drawn.
  std::mt19937_64 draw(1);
  const auto number = [&draw] { return 2 * (static_cast<double>(draw() >> 11) * 0x1p-53) - 1; };
  Worst_pose found;
  // In radians, where climbing ends: the limit differs by less than a hundred-thousandth between such neighbours.
  constexpr double finest_step = 1e-5;
  for (Worst_pose& start : worst) {
    for (double step = 2 * span.maxCoeff() / (per_joint - 1); step > finest_step; step /= 2)
      for (int failures = 0; failures < 40;) {
        const double x = number(), y = number(), z = number();
        const Worst_pose next =
            internal::rated_pose(parameters, *home, V(start.pose.theta + step * V(x, y, z)), limits, contains);
        if (badness(next) > badness(start))
          start = next, failures = 0;
        else
          ++failures;
      }
    if (badness(start) > badness(found))
      found = start;
  }
  return found;
}

/// What may be asked of a loop.
struct Passivity_limits {
  double friction = 0;          ///< b_phys at the worst pose, N s/m
  double passive_stiffness = 0; ///< k_p at the damping asked for, N/m
  double stable_stiffness = 0;  ///< k_s
  Worst_pose worst;

  double largest_stiffness() const { return std::max({passive_stiffness, stable_stiffness, 0.0}); }
  bool permits(const Virtual_coupling& coupling) const { return coupling.stiffness <= largest_stiffness(); }
  bool is_passive(const Virtual_coupling& coupling) const { return coupling.stiffness <= passive_stiffness; }
};

/// The limits over the device's places whose scene is in a box. \param delay ticks
inline Passivity_limits passivity_limits(const Device_parameters<double>& parameters, const Force_limits& limits,
                                         const Workspace_map& map, const Eigen::Vector3d& lower,
                                         const Eigen::Vector3d& upper, double damping, double tick, double delay) {
  Passivity_limits found;
  found.worst = worst_pose(parameters, limits, [&](const Eigen::Vector3d& device) {
    const Eigen::Vector3d p = map.to_scene(device);
    return (p.array() >= lower.array()).all() && (p.array() <= upper.array()).all();
  });
  found.friction = found.worst.friction(parameters);
  found.passive_stiffness = passive_stiffness(found.friction, damping, tick, delay);
  found.stable_stiffness = stable_stiffness(found.friction, damping, tick, delay);
  return found;
}

} // namespace haptic_sculpt

#endif
