// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_CONE_OF_BOXES_H
#define HAPTIC_SCULPT_SURFACE_CONE_OF_BOXES_H

#include <haptic_sculpt/surface/Swept_star_3.h>

#include <cmath>

namespace haptic_sculpt {
namespace internal {

/// All boxes (1 - t) B + t T, 0 <= t <= 1, from the box B of a star at its start to the target T. It holds all that the star
/// sweeps, for that is made of convex combinations of points of B with T. On long pushes it is far thinner than one box.
class Cone_of_boxes {
public:
  explicit Cone_of_boxes(const Swept_star_3& star) {
    Box_3 base(star.source);
    for (std::size_t i = 0; i < star.valence; ++i)
      base.include(star.link[i]);
    for (int i = 0; i < 3; ++i) {
      lower_[i] = base.lower[i], upper_[i] = base.upper[i];
      lower_inverse_[i] = inverse(star.target[i] - base.lower[i]);
      upper_inverse_[i] = inverse(star.target[i] - base.upper[i]);
    }
  }

  /// False only if no box of the cone meets the closed box: for each axis the t with (1 - t) B.lower + t T <= upper and
  /// (1 - t) B.upper + t T >= lower make two rays; the six have to have a t in common. Quotients are off by a few 2^-52 of
  /// themselves, and matter only within [0, 1], so `slack` is ample.
  bool may_meet(const double* lower, const double* upper) const {
    double first = 0, last = 1;
    for (int i = 0; i < 3; ++i) {
      const double to_upper = (upper[i] - lower_[i]) * lower_inverse_[i];
      if (lower_inverse_[i] > 0)
        last = to_upper < last ? to_upper : last;
      else
        first = to_upper > first ? to_upper : first;
      const double to_lower = (lower[i] - upper_[i]) * upper_inverse_[i];
      if (upper_inverse_[i] > 0)
        first = to_lower > first ? to_lower : first;
      else
        last = to_lower < last ? to_lower : last;
    }
    return !(first > last + slack);
  }

private:
  static constexpr double slack = 0x1p-40; ///< of t, which has no unit

  /// NaN, which fails every comparison and so restricts nothing, where the inverse or its argument is out of range.
  static double inverse(double extent) {
    const double result = 1 / extent;
    return std::isfinite(result) && result != 0 ? result : std::numeric_limits<double>::quiet_NaN();
  }

  std::array<double, 3> lower_, upper_, lower_inverse_, upper_inverse_;
};

} // namespace internal
} // namespace haptic_sculpt

#endif
