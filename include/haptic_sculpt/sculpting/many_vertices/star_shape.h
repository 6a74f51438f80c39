// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_STAR_SHAPE_H
#define HAPTIC_SCULPT_SCULPTING_STAR_SHAPE_H

#include <haptic_sculpt/sculpting/many_vertices/triangle_shape.h>
#include <haptic_sculpt/surface/star.h>

namespace haptic_sculpt {
namespace internal {

/// sin^2 of five degrees: no operation makes a triangle with a smaller angle, unless the least angle there was smaller
/// before.
constexpr double least_wanted_angle = 0.0076;

/// Whether the star of a vertex at `from` stays as good when the vertex goes to `to`: no triangle turns its normal by a
/// right angle or more, and the least angle is at least the smaller of least_wanted_angle and what it was. Triangles
/// with the link's vertex `without` do not count: they are no more. \return the new least angle's measure, or -1
template <class Mesh>
double shape_after_move(const Star<Mesh>& star, const Coordinates& from, const Coordinates& to,
                        std::size_t without = static_cast<std::size_t>(-1)) {
  double least = 1, least_before = 1;
  for (std::size_t i = 0; i < star.valence(); ++i) {
    const std::size_t j = star.next(i);
    const Coordinates &a = star.link_points[j], &b = star.link_points[i];
    least_before = smaller(least_before, least_angle_measure(from, a, b));
    if (i == without || j == without)
      continue;
    if (!point_alike(area_normal(from, a, b), area_normal(to, a, b)))
      return -1;
    least = smaller(least, least_angle_measure(to, a, b));
  }
  return least >= smaller(least_wanted_angle, least_before) ? least : -1;
}

} // namespace internal
} // namespace haptic_sculpt

#endif
