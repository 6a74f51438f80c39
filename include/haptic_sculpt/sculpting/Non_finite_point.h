// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>
#include <haptic_sculpt/surface/coordinate_range.h>

namespace haptic_sculpt {

/// A point with a coordinate that is not a finite number was given as a target.
class Non_finite_point : public Out_of_range {
public:
  /// Names the coordinates of p.
  template <class Point_3>
  explicit Non_finite_point(const Point_3& p)
      : Out_of_range("the point (" + internal::number(p.x()) + ", " + internal::number(p.y()) + ", " +
                     internal::number(p.z()) + ") is not finite: give three finite coordinates") {}
};

} // namespace haptic_sculpt
