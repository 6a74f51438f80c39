// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_rendering/Contact_run.h"

#include <haptic_sculpt/haptic_rendering/Passivity_limits.h>

namespace haptic_rendering_tests {

/// A device as it is built, and the ball about home for which couplings are chosen.
struct Knocked_device {
  Device_parameters<double> device;
  Device_pose<double> home;
  double friction, count, mass; ///< at the worst poses: N s/m, m of the handle in one of the encoders, kg

  explicit Knocked_device(Device_form form) : device(built(form)), home(*home_pose(device)) {
    const double radius = 0.9 * workspace_radius(device, home);
    const auto is_inside = [&](const Vector3d& p) { return (p - home.position).norm() <= radius; };
    const Worst_pose worst = worst_pose(device, Force_limits(), is_inside, 15);
    friction = worst.friction(device), count = worst.count(device);
    mass = lightest_pose(device, Force_limits(), is_inside, 9).apparent_mass(device);
  }
  static Device_parameters<double> built(Device_form form) {
    Device_description<double> d = named_design<double>(Named_design::D1, form);
    d.viscous_friction = 0.005, d.coulomb_friction = 0.0005, d.encoder_step = 1.53e-4;
    return Device_parameters<double>(d);
  }
};

/// How hard, and with what; everything else as it ships.
struct Knock {
  double rate = 1000, delay = 0;                       ///< Hz, ticks
  double stiffness_share = 0.95, damping_share = 0; ///< of the stiffness that may be asked for, of b_phys
  std::optional<Simulated_hand> hand{};                                     ///< none: thrown
  double wait = 0.35;                                                       ///< s before it; 0: the ramp is not over
  Vector3d normal{0, 0, 1};
};

/// A hand comes down from the ball's edge at 300 mm/s, 6 mm into a plane through home, and rests there; or the handle
/// is thrown at it.
inline Contact_setup knock(const Knocked_device& knocked, const Knock& k) {
  const bool is_held = k.hand.has_value();
  const double edge = knocked.device.description().form == Device_form::general ? 0.012 : 0.024,
               above = is_held ? edge : 0.002, below = is_held ? 0.006 : -0.002 + 1e-6;
  const Hand_path path({{-1, knocked.home.position + above * k.normal, 0},
                        {k.wait, knocked.home.position + above * k.normal, 0},
                        {k.wait + (above + below) / 0.3, knocked.home.position - below * k.normal, 0}});
  Contact_setup setup{knocked.device,
                      *reach_position(knocked.device, knocked.home, path.rows().front().position),
                      knocked.home.position,
                      k.normal,
                      path,
                      k.hand.value_or(Simulated_hand{1, {}})};
  setup.tick = 1 / k.rate, setup.delay = k.delay, setup.greatest = setup.most_condition = 1e9;
  const double damping = k.damping_share * knocked.friction;
  setup.follows_pose = k.stiffness_share <= 1;
  const double largest = std::fmin(passive_stiffness(knocked.friction, damping, setup.tick, setup.delay),
                                   calm_stiffness(knocked.count, damping));
  setup.coupling = {k.stiffness_share * largest, damping};
  setup.controller_damping =
      0.5 * knocked.mass * largest_damping_rate(setup.tick, setup.delay, std::numeric_limits<double>::infinity());
  if (!is_held)
    setup.speed = -0.3 * k.normal, setup.push_time = k.wait;
  return setup;
}

struct Knock_outcome {
  Contact_outcome run;
  double ripple = 0; ///< N, peak to peak, from half a second after the knock on
};

inline Knock_outcome run_knock(const Contact_setup& setup, double wait) {
  Knock_outcome outcome;
  double low = 1e9, high = 0;
  outcome.run =
      run_contact(setup, 1e9, [&](const Simulated_device& device, const auto&, const auto& made) {
        if (device.time() > wait + 0.6) // it has come down after 0.1
          low = std::fmin(low, made.force.norm()), high = std::fmax(high, made.force.norm());
        return device.time() < wait + 0.75;
      });
  outcome.ripple = std::fmax(0, high - low);
  return outcome;
}

} // namespace haptic_rendering_tests
