// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_passivity/Options.h"
#include "haptic_passivity/stability.h"

#include <haptic_sculpt/haptic_rendering/Passivity_limits.h>

#include <cstdio>

namespace haptic_sculpt::passivity_benchmark {

/// Limits of stiffness over tick, delay and damping, at the worst pose of the ball about home.
inline Json chart() {
  const Device_parameters<double> device = design(Device_form::ditetrahedral, 0.005, 0, 0, 10);
  const auto home = home_pose(device);
  const double radius = workspace_radius(device, *home);
  const Worst_pose worst = worst_pose(
      device, Force_limits(), [&](const Eigen::Vector3d& p) { return (p - home->position).norm() <= 0.9 * radius; });
  const double friction = worst.friction(device);
  const double mass = worst.apparent_mass(device);
  std::printf("at the worst pose: friction %.3f N s/m, least apparent mass %.1f g\n", friction, 1e3 * mass);
  Json rows = Json::array(), masses = Json::array(), dampings = Json::array();
  const auto point = [&](double tick, double delay, double damping) {
    const double k_p = passive_stiffness(friction, damping, tick, delay);
    const double most = 4 * passive_stiffness(friction, 0, tick, delay);
    const double stable = largest_stable_stiffness(device, worst.pose, damping, tick, delay, most);
    rows.push_back({{"tick_s", tick},
                    {"delay", delay},
                    {"damping", damping},
                    {"passive_formula", k_p},
                    {"stable_to", stable}});
    if (damping == 0) // a slow motion is damped by b, and would not find what b costs
      rows.back()["active_from"] = activity_stiffness(device, worst.pose, 0, tick, delay);
    std::printf("T %.2f ms, d %.1f, b %.2f: k_p %.0f, calm to %.0f N/m", 1e3 * tick, delay, damping, k_p, stable);
    if (damping == 0)
      std::printf(", activity from %.0f", rows.back()["active_from"].get<double>());
    std::printf("\n");
    std::fflush(stdout);
  };
  for (const double delay : {0.0, 0.5, 1.0})
    for (const double share : {0.0, 0.25, 0.5, 0.75, 0.95})
      point(0.001, delay, share * friction);
  for (const double tick : {0.00025, 0.0005, 0.002, 0.004})
    for (const double share : {0.0, 0.5, 0.95})
      point(tick, 0, share * friction);
  for (const double tick : {0.00025, 0.001, 0.004})
    for (const double delay : {0.0, 1.0}) {
      const double k = 0.5 * passive_stiffness(friction, 0, tick, delay);
      const double damping = largest_stable_damping(device, worst.pose, k, tick, delay, 100 * friction);
      dampings.push_back({{"tick_s", tick}, {"delay", delay}, {"stiffness", k}, {"stable_to", damping}});
      std::printf("T %.2f ms, d %.0f, k %.0f N/m: damping stable to %.2f N s/m\n", 1e3 * tick, delay, k, damping);
      const double virtual_mass = largest_stable_mass(device, worst.pose, tick, delay, 0.4);
      masses.push_back({{"tick_s", tick}, {"delay", delay}, {"stable_to_kg", virtual_mass}});
      std::fflush(stdout);
      std::printf("T %.2f ms, d %.0f: virtual mass stable to %.1f g\n", 1e3 * tick, delay, 1e3 * virtual_mass);
    }
  return {{"friction_Ns_m", friction},
          {"greatest_m_rad", worst.greatest},
          {"apparent_mass_kg", mass},
          {"rows", rows},
          {"damping", dampings},
          {"virtual_mass", masses}};
}

} // namespace haptic_sculpt::passivity_benchmark
