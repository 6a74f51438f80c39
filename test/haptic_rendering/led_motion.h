// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_rendering/held_scenes.h"

#include <haptic_sculpt/haptic_rendering.h>

#include <boost/test/unit_test.hpp>

namespace haptic_rendering_tests {

using namespace haptic_sculpt;
using Mesh = meshes::Mesh;
constexpr double stiffness = 700; // N/m

/// The loop, with the handle led along a line through a plane at constant speed.
struct Led_motion {
  double rate, delay, speed, encoder_step;
  bool is_normal; ///< straight at the plane
};

struct Force_error {
  double mean = 0, largest = 0, felt_mean = 0, greatest = 0;
};

/// Of the force in the hand against the spring's at that moment, N; sampled within ticks.
inline Force_error error_of(const Led_motion& led, std::uint64_t seed) {
  Random random(seed);
  Device_description<double> description = named_design<double>(Named_design::D1, Device_form::ditetrahedral);
  description.torque_limit = 100, description.encoder_step = led.encoder_step;
  description.viscous_friction = 0.2; // N m s/rad: enough for the slowest and latest loop
  const Device_parameters<double> device(description);
  const auto home = home_pose(device);
  Mesh mesh = meshes::to_mesh(meshes::box(3, 1));
  Sculptor<Mesh> sculptor(mesh);
  const Workspace_map map(20, random_vector(random, 0.4), Vector3d(0.5, 0.45, 1), home->position);
  const Vector3d normal = map.direction_to_device(Vector3d(0, 0, 1));
  Vector3d direction = -normal;
  if (!led.is_normal)
    direction = (direction + 0.5 * random_vector(random).cross(normal).normalized()).normalized();
  Haptic_parameters parameters;
  parameters.tick = 1 / led.rate, parameters.delay = led.delay, parameters.coupling = {stiffness, 0};
  parameters.gravity = Gravity_compensation::none, parameters.controller_damping = 0;
  parameters.limits.slew = parameters.limits.largest = 1e9, parameters.limits.ramp_time = 1e-9;
  const auto is_near = [&](const Vector3d& p) { return (p - home->position).norm() <= 0.025; }; // m
  static const Worst_pose worst = worst_pose(device, parameters.limits, is_near, 15),
                          lightest = lightest_pose(device, parameters.limits, is_near, 9);
  const Passivity_limits limits =
      passivity_limits(device, parameters.limits, map, worst, lightest, 0, parameters.tick, led.delay);
  const double before = 0.001 + 3 * led.speed / led.rate,
               after = std::max(0.003, 8 * led.speed / led.rate); // metres before and behind the plane
  const auto start = reach_position(device, *home, Vector3d(home->position - before * direction));
  Haptic_loop<Sculptor<Mesh>> loop(sculptor, device, *start, map, parameters, limits);
  Torque_delay<double> held_force(led.delay), held_torque(led.delay);
  Device_pose<double> pose = *start;
  Force_error error;
  int samples = 0, touching = 0;
  constexpr int parts = 8;
  const int ticks = static_cast<int>((before + after) / led.speed * led.rate);
  const auto place = [&](double t) { return Vector3d(start->position + led.speed * t * direction); };
  for (int k = 0; k < ticks; ++k) {
    pose = *reach_position(device, pose, place(k / led.rate));
    Joint_reading reading;
    reading.theta = measured_angles(device, pose.theta), reading.elapsed = k == 0 ? 0 : 1 / led.rate;
    const Haptic_tick& made = loop.tick(reading);
    BOOST_REQUIRE((made.fault == Loop_fault::none));
    held_force.command(made.rendered.force), held_torque.command(made.rendered.interaction_torque);
    touching = made.tool.reached ? 0 : touching + 1;
    if (touching < 3 + static_cast<int>(led.delay))
      continue; // a command of free motion is still in force
    for (int part = 0; part < parts; ++part) {
      const double fraction = (part + 0.5) / parts;
      const auto there = reach_position(device, pose, place((k + fraction) / led.rate));
      const Vector3d exact = -stiffness * normal * normal.dot(there->position - home->position);
      const bool is_old = fraction < held_force.fraction();
      const Vector3d force = is_old ? held_force.before() : held_force.after();
      const Matrix3d linear = jacobian(device, *there)->linear;
      const Vector3d felt =
          linear.transpose().partialPivLu().solve(is_old ? held_torque.before() : held_torque.after());
      const double off = (force - exact).norm();
      error.mean += off, error.largest = std::max(error.largest, off), error.felt_mean += (felt - exact).norm();
      error.greatest = std::max(error.greatest, translation_conditioning(*jacobian(device, *there)).greatest);
      ++samples;
    }
  }
  BOOST_REQUIRE(samples > 0);
  error.mean /= samples, error.felt_mean /= samples;
  return error;
}

} // namespace haptic_rendering_tests
