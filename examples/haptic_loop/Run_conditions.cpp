// SPDX-License-Identifier: GPL-3.0-or-later
#include "Run_conditions.h"

#include "../common/numbers.h"

#include <haptic_sculpt/haptic_rendering/reach_position.h>

namespace haptic_sculpt::loop_program {

Run_conditions::Run_conditions(const Plan& plan)
    : plan_(plan), settings_(plan.settings), tick_(1 / settings_.rate), device_(settings_.device), home_(home()) {}

Device_pose<double> Run_conditions::home() const {
  return of_settings([&] {
    if (const auto home = home_pose(device_))
      return *home;
    throw Usage_error("the device has no pose in the middle of its joint limits");
  });
}

Haptic_parameters Run_conditions::parameters() const {
  Haptic_parameters parameters;
  parameters.tick = tick_, parameters.delay = settings_.delay;
  parameters.coupling = {settings_.stiffness, settings_.damping};
  parameters.snap = settings_.snap;
  parameters.virtual_mass.mass = settings_.virtual_mass;
  parameters.controller_damping = settings_.controller;
  parameters.reach = settings_.reach, parameters.work_limit = settings_.work;
  return parameters;
}

Workspace_map Run_conditions::map(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) const {
  return of_settings([&] {
    const std::vector<double>& m = settings_.map;
    if (m.empty())
      return Workspace_map::fitted(lower, upper, home_.position, workspace_radius(device_, home_));
    const Eigen::Vector3d rotation = m.size() == 7 ? Eigen::Vector3d(m[4], m[5], m[6]) : Eigen::Vector3d(0, 0, 0);
    return Workspace_map(m[0], rotation, {m[1], m[2], m[3]}, home_.position);
  });
}

Passivity_limits Run_conditions::limits(const Haptic_parameters& parameters, const Workspace_map& map,
                                        const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) const {
  return of_settings([&] {
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(0.1 * (upper - lower).stableNorm());
    const Passivity_limits limits = passivity_limits(device_, parameters.limits, map, lower - margin, upper + margin,
                                                     settings_.damping, tick_, settings_.delay);
    if (!limits.worst.is_found)
      throw Usage_error("the map leads to no place that the device can reach; see --map");
    return limits;
  });
}

void Run_conditions::check(const Haptic_parameters& parameters, const Passivity_limits& limits) const {
  try {
    check_forces(parameters, limits);
  } catch (const Unstable_coupling& error) {
    if (settings_.device.viscous_friction > 0)
      throw;
    throw Unstable_coupling(error.what() + std::string(". This device has no `friction` (N m s/rad), without which "
                                                       "nothing is passive: give its joints' in the device's file"));
  }
}

Device_pose<double> Run_conditions::start() const {
  return of_settings([&] {
    if (!settings_.begin)
      return start_of_recording();
    const Eigen::Vector3d& begin = *settings_.begin;
    const auto start = reach_position(device_, home_, begin);
    if (!start)
      throw Usage_error("the device cannot come to where the path begins, at " + examples::decimal(begin[0]) + ", " +
                        examples::decimal(begin[1]) + ", " + examples::decimal(begin[2]) +
                        " m; begin it nearer to where the handle is at home");
    return *start;
  });
}

/// Of one of before there was a place to begin at in it.
Device_pose<double> Run_conditions::start_of_recording() const {
  const auto& readings = plan_.replay->readings;
  if (readings.empty() || !readings[0].theta.allFinite())
    return home_;
  const auto pose = forward_kinematics(device_, readings[0].theta, home_);
  return pose ? *pose : home_;
}

} // namespace haptic_sculpt::loop_program
