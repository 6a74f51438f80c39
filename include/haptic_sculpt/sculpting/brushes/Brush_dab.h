// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_BRUSH_DAB_H
#define HAPTIC_SCULPT_SCULPTING_BRUSH_DAB_H

#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/collision/arithmetic/unit_of.h>
#include <haptic_sculpt/sculpting/brushes/Brush_kind.h>

#include <cmath>
#include <optional>

namespace haptic_sculpt {

/// One dab of a brush. \tparam Kernel that of the points of the mesh
template <class Kernel>
struct Brush_dab {
  Brush_kind kind;                  ///< what it does
  typename Kernel::Point_3 centre;  ///< where
  double radius;                    ///< > 0; the effect falls off to nothing there, as (1 - (distance / radius)^2)^2
  double strength;                  ///< a length or a share (Brush_kind); may be negative
  std::optional<typename Kernel::Vector_3> direction = {}; ///< of any length; the mean normal of what is touched where none is given
};

namespace internal {

/// Multiplied by the power of two that brings its largest coordinate to about 1: squares and products of what is measured in
/// metres or in light years are doubles then. Zero for zero.
template <class Vector_3>
Vector_3 of_size_one(const Vector_3& v) {
  return v * unit_of(std::fmax(std::fabs(v.x()), std::fmax(std::fabs(v.y()), std::fabs(v.z()))));
}

/// Unit length; zero for zero.
template <class Vector_3>
Vector_3 unit_vector(const Vector_3& v) {
  const Vector_3 direction = of_size_one(v);
  const double length = std::sqrt(direction.squared_length());
  return length > 0 ? direction / length : v;
}

} // namespace internal

/// The same dab on the other side of a plane: both together, given to apply_brush() as one, keep a symmetric mesh symmetric.
template <class Kernel>
Brush_dab<Kernel> mirrored(Brush_dab<Kernel> dab, const typename Kernel::Plane_3& plane) {
  const internal::Rounding_to_nearest rounding;
  const auto n = internal::unit_vector(plane.orthogonal_vector());
  const auto reflect = [&](const typename Kernel::Vector_3& v) { return v - 2 * (v * n) * n; };
  const auto foot = dab.centre - ((dab.centre - plane.point()) * n) * n;
  dab.centre = foot + reflect(dab.centre - foot);
  if (dab.direction)
    dab.direction = reflect(*dab.direction);
  return dab;
}

} // namespace haptic_sculpt

#endif
