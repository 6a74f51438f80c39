// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/Device_pose.h>

/// \file
/// What is certain of the elbows while the joints turn straight to other angles (doc/proofs/device.md).

namespace haptic_sculpt::internal {

/// Whether the elbows, from where they are, are certain not to come on one line while no joint turns by more than
/// `turned` rad: each moves by at most l1 times that, which changes the normal of their triangle by less than its
/// length, rounding taken off. Sufficient, not necessary: shorter steps decide more.
template <class S>
bool elbows_stay_off_a_line(const Device_parameters<S>& parameters, const Device_matrix<S>& elbows, const S& turned) {
  const Device_vector<S> a = elbows.col(1) - elbows.col(0), b = elbows.col(2) - elbows.col(0);
  const S moved = S(2) * parameters.primary_length() * turned; // one end of a side, as seen from the other
  const S sides = a.norm() + b.norm();
  // m^2: a coordinate of an elbow is off by 5 roundings of R + l1, half of epsilon each: the normal by 22 of these
  // times the sides, and by 5 of the product of the sides, which is no more: 27 halves, and room.
  const S rounding_of_normal =
      S(16) * std::numeric_limits<S>::epsilon() * (parameters.base_radius() + parameters.primary_length()) * sides;
  return moved * (sides + moved) < a.cross(b).norm() - rounding_of_normal;
}

/// How far the three |B_i - B_j|^2 / l2^2 stray, at most, from the straight line between their values at both ends of
/// a way on which no joint turns by more than `turned` rad: an eighth of their second derivative. In the joint angles
/// they are what the closure has in the link angles, with R, l1 for r, l2.
template <class S>
S strayed_separation(const Device_parameters<S>& parameters, const S& turned) {
  const S& l1 = parameters.primary_length();
  return (S(6) * parameters.base_radius() + S(8) * l1) * l1 * parameters.inverse_secondary_length_squared() *
         (turned * turned / S(8));
}

} // namespace haptic_sculpt::internal
