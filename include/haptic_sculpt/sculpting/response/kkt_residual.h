// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/response/nearest_permitted.h>

namespace haptic_sculpt::internal {

/// The distance from `pull` to the cone of all combinations of `-normals` with weights >= 0, over |pull|: 0 where the
/// contacts hold the vertex at a constrained nearest point to its target, 1 where none of them resists.
///
/// By Moreau's decomposition it is the length of the part of the pull that the contacts permit: the projection of the
/// pull on the polar cone, which is that of the displacements d with normal . d >= 0. \param half_spaces those, `least`
/// being 0 Cost: that of nearest_permitted(). Floating point.
template <class Half_spaces>
double kkt_residual(const Vector& pull, const Half_spaces& half_spaces) {
  // What rounding leaves of a product of a normal and a direction of length 1, and of the meeting of nearly parallel
  // planes.
  constexpr double slack = 0x1p-46;
  const double pull_length = length(pull);
  if (pull_length == 0)
    return 0;
  const double unit = unit_of(pull_length); // the inverse of a subnormal number overflows
  const Nearest_permitted permitted =
      nearest_permitted(scaled(scaled(pull, unit), 1 / (pull_length * unit)), half_spaces, slack, slack);
  return permitted.exists ? std::fmin(1.0, length(permitted.displacement)) : 0;
}

} // namespace haptic_sculpt::internal
