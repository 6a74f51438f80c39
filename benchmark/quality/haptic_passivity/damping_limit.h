// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_passivity/Options.h"
#include "haptic_passivity/stability.h"

#include <haptic_sculpt/haptic_rendering/Passivity_limits.h>

#include <cstdio>

namespace haptic_sculpt::passivity_benchmark {

/// The largest damping that may be asked for, alone and half of it with all the stiffness that is passive beside it, in
/// hands from soft ones to a clamp: whether one of them buzzes on a plane, at the lightest pose of the ball about home.
inline Json damping_in_hands(const Options& options) {
  constexpr double hand_stiffnesses[] = {3000, 2000, 1000, 300, 50}, hand_dampings[] = {0.3, 3, 15}; // N/m, N s/m
  Json rows = Json::array();
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_parameters<double> device = design(form, 0.005, 0, 0, 10);
    const auto home = home_pose(device);
    const Workspace_map map(1, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), home->position);
    const Eigen::Vector3d corner = Eigen::Vector3d::Constant(0.9 * workspace_radius(device, *home) / std::sqrt(3.0));
    const Force_limits forces;
    const Passivity_limits any = passivity_limits(device, forces, map, -corner, corner, 0, 0.001, 0);
    for (const double tick : {0.0001, 0.00025, 0.001, 0.004})
      for (const double delay : {0.0, 0.5, 1.0, 2.0}) {
        const auto limits = passivity_limits(device, forces, map, any.worst, any.lightest, 0, tick, delay);
        const double b = limits.largest_damping;
        const Virtual_coupling couplings[] = {{0, b}, {passive_stiffness(limits.friction, b / 2, tick, delay), b / 2}};
        int hands = 0, calm = 0;
        Json buzzing = Json::array();
        for (int k = 0; k < options.damping_hands; ++k)
          for (const Virtual_coupling& coupling : couplings) {
            const double stiffness = hand_stiffnesses[k / 3], damping = hand_dampings[k % 3];
            const Simulated_hand hand{1, {{{0, stiffness, damping}}}};
            ++hands;
            if (is_calm(pressed(device, limits.lightest.pose, hand, coupling, tick, delay)))
              ++calm;
            else
              buzzing.push_back({{"hand_stiffness", stiffness},
                                 {"hand_damping", damping},
                                 {"stiffness", coupling.stiffness},
                                 {"damping", coupling.damping}});
          }
        const char* name = form == Device_form::ditetrahedral ? "ditetrahedral" : "general";
        rows.push_back({{"form", name},
                        {"tick_s", tick},
                        {"delay", delay},
                        {"largest_damping", b},
                        {"hands", hands},
                        {"calm", calm},
                        {"buzzing", buzzing}});
        std::printf("damping up to %.3f N s/m, %s, T %.2f ms, d %.1f: calm in %d of %d hands up to 3,000 N/m\n", b,
                    name, 1e3 * tick, delay, calm, hands);
        std::fflush(stdout);
      }
  }
  return rows;
}

} // namespace haptic_sculpt::passivity_benchmark
