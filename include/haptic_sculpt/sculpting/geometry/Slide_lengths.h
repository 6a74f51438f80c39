// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace haptic_sculpt::internal {

/// The lengths of a slide where J is. All in the unit of the coordinates.
struct Slide_lengths {
  double clearance;  ///< c: the largest that is kept from a contact plane here
  double resolution; ///< one unit in the last place of the contacts and of J: what rounding a point can do

  /// Higher than this over its plane J has left a contact.
  double lifted() const { return clearances_of_lift * clearance; }
  /// Nearer than this to the border of a facet another feature may be near.
  double border() const { return 16 * clearance; }
  /// A leg no longer than this is not worth making: it is what rounding leaves of a perfect one.
  double settled() const { return 2 * resolution; }
  /// A pull no longer than this says nothing about its direction.
  double shortest_pull() const { return 16 * clearance; }
  /// To be a clearance off two planes J may have to go back from its target by a clearance over the sine of half their
  /// angle. No farther than this: in a gap more acute than a hundredth of a radian less than a clearance is kept.
  double retreat() const { return clearances_of_retreat * clearance; }
  /// Normals are rounded, and over a longer leg along a plane that would take J off it, or into it, by hundreds of
  /// clearances. A target that is farther is approached in more than one leg: the cone of the contacts' normals, which
  /// says whether J is at a nearest point, does not depend on how far the target is.
  double farthest_pull() const { return 0x1p62 * resolution; }

  double noise() const { return 0x1p-64 * resolution; }

  /// In clearances of the contact at hand: higher over its plane J has left it.
  static constexpr double clearances_of_lift = 8, clearances_of_retreat = 128;
};

} // namespace haptic_sculpt::internal
