// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/axis_sweep.h>
#include <haptic_sculpt/surface/broad_phase/Box_scale.h>
#include <haptic_sculpt/surface/broad_phase/Eight_flags.h>

#include <array>
#include <cstdint>

namespace haptic_sculpt::internal {

/// The intervals of a face in a motion along one axis, in doubles: of the two other coordinates, which do not change,
/// and of that along the axis at the start and at the end.
struct Axis_bounds {
  Axis_place least, largest;

  explicit Axis_bounds(const Axis_motion<3>& motion) : least(motion.places[0]), largest(least) {
    for (int i = 1; i < 3; ++i)
      for (int k = 0; k < 4; ++k) {
        const double x = motion.places[i][k];
        least[k] = x < least[k] ? x : least[k];
        largest[k] = x > largest[k] ? x : largest[k];
      }
  }

  /// Whether nothing of the one can meet anything of the other: as Axis_box_node::meeting() has it.
  bool are_apart(const Axis_bounds& other) const {
    const auto is_below = [](const Axis_bounds& x, const Axis_bounds& y, int k) { return x.largest[k] < y.least[k]; };
    const auto is_below_all_along = [&](const Axis_bounds& x, const Axis_bounds& y) {
      return is_below(x, y, 2) && is_below(x, y, 3);
    };
    return is_below(*this, other, 0) || is_below(other, *this, 0) || is_below(*this, other, 1) ||
           is_below(other, *this, 1) || is_below_all_along(*this, other) || is_below_all_along(other, *this);
  }
};

/// The same in floats, in a unit of the scene's own, rounded outward.
struct Axis_box {
  std::array<float, 4> lower, upper; ///< of the next coordinate, of the one after, at the start, at the end

  Axis_box() {
    lower.fill(std::numeric_limits<float>::infinity());
    upper.fill(-std::numeric_limits<float>::infinity());
  }

  Axis_box(const Box_scale& scale, const Axis_motion<3>& motion) {
    const Axis_bounds bounds(motion);
    for (int k = 0; k < 4; ++k) {
      lower[k] = scale.below(bounds.least[k]);
      upper[k] = scale.above(bounds.largest[k]);
    }
  }
};

/// The boxes of eight children, bound by bound, so that compilers compare four or eight at once.
struct alignas(64) Axis_box_node {
  static constexpr unsigned width = 8;

  float lower[4][width], upper[4][width];
  std::uint8_t is_there = 0,
               is_active = 0; ///< bits: which children there are, and which have changed, or hold what has

  void set(unsigned j, const Axis_box& box) {
    for (int k = 0; k < 4; ++k)
      lower[k][j] = box.lower[k], upper[k][j] = box.upper[k];
    is_there = static_cast<std::uint8_t>(is_there | 1u << j);
  }

  Axis_box box(unsigned j) const {
    Axis_box result;
    for (int k = 0; k < 4; ++k)
      result.lower[k] = lower[k][j], result.upper[k] = upper[k][j];
    return result;
  }

  /// Around all of them.
  Axis_box all() const {
    Axis_box result;
    for (unsigned j = 0; j < width; ++j)
      if ((is_there >> j & 1) != 0)
        for (int k = 0; k < 4; ++k) {
          result.lower[k] = lower[k][j] < result.lower[k] ? lower[k][j] : result.lower[k];
          result.upper[k] = upper[k][j] > result.upper[k] ? upper[k][j] : result.upper[k];
        }
    return result;
  }

  /// Bit j: whether what is in box j may meet what is in the other at some time. Not where their places seen along the
  /// axis are apart, nor where all of the one is above all of the other both at the start and at the end: heights
  /// change at constant speed, so then it is so between.
  unsigned meeting(const Axis_box& other) const {
    const auto is_above = [&](int k) { return Eight_flags::greater(lower[k], other.upper[k]); };
    const auto is_below = [&](int k) { return Eight_flags::greater(other.lower[k], upper[k]); };
    const Eight_flags is_apart = is_above(0) | is_below(0) | is_above(1) | is_below(1) | (is_above(2) & is_above(3)) |
                                 (is_below(2) & is_below(3));
    return is_apart.where_not() & is_there;
  }
};

} // namespace haptic_sculpt::internal
