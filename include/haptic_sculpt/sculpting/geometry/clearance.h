// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>

namespace haptic_sculpt::internal {

/// How many units in the last place a stop keeps from a contact plane by default.
/// Measured: below 3 a rounded stop often fails its proof and retries; above 4 nothing is gained.
constexpr double default_clearance_ulps = 4;

/// The distance from |x| to the next larger double; 0 for infinities and what is no number.
inline double unit_in_the_last_place(double x) {
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  const std::uint64_t exponent = bits >> 52 & 0x7ff; // |x| < 2^(exponent - 1022)
  const std::uint64_t ulp = exponent == 0x7ff ? 0
                            : exponent > 52   ? (exponent - 52) << 52
                            : exponent > 0    ? std::uint64_t{1} << (exponent - 1)
                                              : 1;
  std::memcpy(&x, &ulp, sizeof x);
  return x;
}

/// The default clearance, a length, of a contact whose vertices and moving vertex have coordinates of at most
/// `largest_coordinate`.
inline double default_clearance(double largest_coordinate) {
  return default_clearance_ulps * unit_in_the_last_place(largest_coordinate);
}

/// What is kept from the plane of a contact: the length that was set, or else default_clearance() of the largest
/// coordinate among the contact's vertices and the moving vertex there. So it depends on what touches and where, not on
/// where the hand points, nor on what else is in the scene, nor on what was before.
class Clearance_rule {
public:
  Clearance_rule() = default;
  explicit Clearance_rule(std::optional<double> length) : set_(length.value_or(0)) {}

  /// Less than an ulp cannot be kept: a vertex that has left the scene keeps one where it is then.
  double at(double largest_coordinate) const {
    if (set_ == 0)
      return default_clearance(largest_coordinate);
    const double ulp = unit_in_the_last_place(largest_coordinate);
    return set_ > ulp ? set_ : ulp;
  }

private:
  double set_ = 0; ///< 0: none
};

/// What a drag has to keep.
struct Drag_rules {
  Clearance_rule clearance;
  double delta = 0; ///< no triangle of the star gets an altitude below this length
};

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
