// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_passivity/stability.h"

#include <haptic_sculpt/haptic_rendering/Passivity_limits.h>

namespace haptic_sculpt::passivity_benchmark {

/// Whether what is asked for buzzes in no hand: the coupling on a wall, the rest wherever it is.
inline bool is_calm_in_every_hand(const Device_parameters<double>& device, const Device_pose<double>& pose,
                                  const Virtual_coupling& coupling, double mass, double controller, double tick,
                                  double delay) {
  for (const Simulated_hand& hand : hands_of_chart()) {
    Contact_setup setup = pressed(device, pose, hand, coupling, tick, delay);
    setup.virtual_mass.mass = mass, setup.controller_damping = controller;
    if (!is_calm(setup))
      return false;
  }
  return true;
}

/// The largest virtual mass and damping that may be asked for, and both sides of where a free mass begins to swing, in
/// the simulated mechanism at the lightest pose of the ball about home.
struct Dynamic_limits {
  Passivity_limits limits;
  double critical_mass = 0, critical_damping = 0; ///< kg, N s/m
  bool holds = false;                             ///< all that may be asked for, together and each alone, is calm
  bool mass_is_calm_below = false, mass_swings_above = false;
  bool damping_is_calm_below = false, damping_swings_above = false;
};

inline Dynamic_limits dynamic_limits(Device_form form, double tick, double delay) {
  const Device_parameters<double> device = design(form, 0.005, 0, 0, 10);
  const auto home = home_pose(device);
  const double radius = 0.9 * workspace_radius(device, *home);
  const Workspace_map map(1, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), home->position);
  const Eigen::Vector3d corner = Eigen::Vector3d::Constant(radius / std::sqrt(3.0));
  const Force_limits limits;
  Dynamic_limits found;
  found.limits = passivity_limits(device, limits, map, -corner, corner, 0, tick, delay);
  const Passivity_limits& l = found.limits;
  found.critical_mass = l.largest_mass / stable_share;
  found.critical_damping = l.apparent_mass * critical_damping_rate(tick, delay);
  const auto is_calm_with = [&](double stiffness, double damping, double mass, double controller) {
    return is_calm_in_every_hand(device, l.lightest.pose, {stiffness, damping}, mass, controller, tick, delay);
  };
  const double k = l.recommended_stiffness(), b = 0.5 * l.largest_damping,
               k_b = passive_stiffness(l.friction, b, tick, delay);
  found.holds = is_calm_with(0, 0, l.largest_mass, 0) && is_calm_with(k, 0, l.largest_mass, 0) &&
                is_calm_with(k_b, b, 0, 0) && is_calm_with(k_b, b, l.largest_mass, l.default_controller());
  for (const Simulated_hand& hand : stiff_hands())
    found.holds = found.holds &&
                  is_calm(pressed(device, l.lightest.pose, hand, {0, l.largest_damping}, tick, delay)) &&
                  is_calm(pressed(device, l.lightest.pose, hand, {k_b, b}, tick, delay));
  found.mass_is_calm_below = is_calm_with(0, 0, 0.8 * found.critical_mass, 0);
  found.mass_swings_above = !is_calm_with(0, 0, 1.2 * found.critical_mass, 0);
  found.damping_is_calm_below =
      is_calm_with(k, std::fmin(0.6 * found.critical_damping, 2 * l.largest_damping), 0, 0);
  // A wall that damps far too much throws the handle off, and it may come to rest beside it.
  found.damping_swings_above =
      !is_calm_with(k, 1.3 * found.critical_damping, 0, 0) || !is_calm_with(k, 2 * found.critical_damping, 0, 0);
  return found;
}

} // namespace haptic_sculpt::passivity_benchmark
