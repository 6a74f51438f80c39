// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/sculpting/brushes/scaled_directions.h>

#include <optional>
#include <string>

namespace haptic_sculpt {

/// What a brush does with what it touches.
enum class Brush_kind {
  grab,    ///< moves it along the direction of the dab, by the strength as a length
  inflate, ///< moves each vertex out of the solid along its normal, by the strength as a length
  smooth,  ///< moves each vertex towards the mean of its neighbours, by the strength as a share of the way
  flatten, ///< moves it onto the plane through its mean, across the direction, by the strength as a share of the way
  pinch    ///< moves it towards the line through the centre along the direction, by the strength as a share of the way
};

/// \return the kind called "grab", "inflate", "smooth", "flatten" or "pinch"; nothing for any other word
inline std::optional<Brush_kind> brush_kind(const std::string& name) {
  const char* const names[] = {"grab", "inflate", "smooth", "flatten", "pinch"};
  for (int i = 0; i < 5; ++i)
    if (name == names[i])
      return static_cast<Brush_kind>(i);
  return std::nullopt;
}

/// One touch of a brush. Its effect is largest at the centre and nothing at the radius: it is multiplied by
/// (1 - (distance / radius)^2)^2.
template <class Kernel>
struct Dab_3 {
  Brush_kind kind; ///< what it does
  typename Kernel::Point_3 centre; ///< on the surface, or near it
  double radius;   ///< >= 0, in the unit of the coordinates; 0 touches nothing
  double strength; ///< a length or a share, as the kind says; negative: the other way
  std::optional<typename Kernel::Vector_3> direction = {}; ///< of any length but 0; else the mean normal there

  /// The square of how far a point is from the centre, in radii.
  double squared_share(const typename Kernel::Point_3& p) const {
    const internal::Rounding_to_nearest rounding;
    const auto d = p - centre;
    const double x = d.x() / radius, y = d.y() / radius, z = d.z() / radius;
    return internal::kept(x * x + y * y + z * z);
  }
};

/// The same dab on the other side of a plane.
template <class Kernel>
Dab_3<Kernel> mirrored(Dab_3<Kernel> dab, const typename Kernel::Plane_3& plane) {
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
