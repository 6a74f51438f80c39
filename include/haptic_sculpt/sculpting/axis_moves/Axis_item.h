// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace haptic_sculpt::internal {

/// A face, as an axis move looks at it.
struct Axis_item {
  std::array<std::uint32_t, 3> corners;
  std::uint8_t owned;        ///< bits: of the corners 0, 1, 2 and the edges after them, those looked at with this face
  std::int8_t side;          ///< the orientation as seen along the axis
  std::uint8_t unfolded = 0; ///< bits: of the corners, those whose stars are seen along the axis without a fold
  bool moves = false;        ///< at the start of the motion
};

/// Bits: which corners of f are corners of g. Without a branch: most pairs found are neighbours, in no order that a
/// processor could foresee.
inline unsigned shared_corners(const Axis_item& f, const Axis_item& g) {
  unsigned shared = 0;
  for (unsigned i = 0; i < 3; ++i) {
    const std::uint32_t v = f.corners[i];
    shared |= (unsigned(v == g.corners[0]) | unsigned(v == g.corners[1]) | unsigned(v == g.corners[2])) << i;
  }
  return shared;
}

/// Whether two faces share no more than these corners of f as seen along the axis: their tests would all be passed.
inline bool are_side_by_side(const Axis_item& f, const Axis_item& g, unsigned shared) {
  const bool is_edge = (shared & (shared - 1)) != 0;
  return f.side != 0 && f.side == g.side && shared != 0 && (is_edge || (f.unfolded & shared) != 0);
}

} // namespace haptic_sculpt::internal
