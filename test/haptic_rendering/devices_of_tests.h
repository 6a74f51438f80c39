// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_rendering/random_vector.h"

#include <haptic_sculpt/haptic_rendering/Force_limit.h>
#include <haptic_sculpt/haptic_rendering/Handle_motion.h>
#include <haptic_sculpt/haptic_rendering/reach_position.h>

namespace haptic_rendering_tests {

using namespace haptic_sculpt;

inline Device_parameters<double> device(Device_form form, double friction = 0.005, double encoder_step = 0) {
  Device_description<double> d = named_design<double>(Named_design::D1, form);
  d.viscous_friction = friction, d.encoder_step = encoder_step;
  return Device_parameters<double>(d);
}

inline Handle_motion handle_at(const Device_parameters<double>& parameters, const Vector3d& theta) {
  Handle_motion handle(parameters, *home_pose(parameters), 0.001);
  handle.follow(theta);
  return handle;
}

/// Nothing between the wanted force and the motors.
inline Force_limits no_limits() {
  Force_limits limits;
  limits.slew = limits.largest = 1e9, limits.ramp_time = 1e-9;
  limits.full_condition = limits.no_condition = 1e9;
  return limits;
}

} // namespace haptic_rendering_tests
