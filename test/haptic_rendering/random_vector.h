// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <random>

namespace haptic_rendering_tests {

using Eigen::Vector3d;
using Random = std::mt19937_64;

inline Vector3d random_vector(Random& random, double length = 1) {
  std::normal_distribution<double> number;
  const double x = number(random), y = number(random), z = number(random);
  return length * Vector3d(x, y, z);
}

} // namespace haptic_rendering_tests
