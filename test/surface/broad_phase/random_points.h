// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "seeds_and_sizes.h"

#include <array>
#include <cstdint>
#include <random>

namespace broad_phase_tests {

using Random = std::mt19937_64;
using Coordinates = std::array<double, 3>;

inline std::uint64_t seed() { return haptic_sculpt::test::seed_from_environment(20260101); }

inline double uniform(Random& random) {
  return static_cast<double>(random() >> 11) * 0x1p-52 - 1;
}

/// A point of a coarse grid, or anywhere, in [-size, size]^3.
inline Coordinates random_point(Random& random, double size) {
  Coordinates p;
  const bool on_grid = random() % 2 == 0;
  for (double& x : p)
    x = on_grid ? size / 4 * (static_cast<double>(random() % 9) - 4) : size * uniform(random);
  return p;
}

} // namespace broad_phase_tests
