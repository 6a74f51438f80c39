// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Pose_loop.h>
#include <haptic_sculpt/haptic_rendering/Pose_reading.h>
#include <haptic_sculpt/haptic_rendering/Workspace_map.h>

#include <cmath>
#include <cstdint>

namespace exchange_tests {

using namespace haptic_sculpt;
using Eigen::Vector3d;

inline const Workspace_map map_of_tests(50, Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero());

/// A hand that goes about the ball: comes down on it, presses the button, pulls outwards, lets go; and so on.
inline Pose_reading reading_at(std::uint64_t tick) {
  const std::uint64_t phase = tick % 700;
  const double a = 0.002 * static_cast<double>(tick), p = static_cast<double>(phase);
  const double r = phase < 150   ? 1.25
                   : phase < 300 ? 1.25 - 0.35 * (p - 150) / 150
                   : phase < 600 ? 0.9 + 0.4 * (p - 300) / 300
                                 : 1.3 - 0.05 * (p - 600) / 100;
  Pose_reading reading;
  reading.position = map_of_tests.to_device(
      r * Vector3d(std::cos(a), std::sin(a) * std::cos(0.3 * a), std::sin(a) * std::sin(0.3 * a)));
  reading.button = phase < 300 ? 0 : phase < 600 ? 1 : phase < 620 ? 2 : 0;
  reading.elapsed = 0.001;
  return reading;
}

inline Pose_loop_parameters parameters_of_tests() {
  Pose_loop_parameters parameters(2); // N s/m
  parameters.reach = 0.003;
  return parameters;
}

} // namespace exchange_tests
