// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/many_vertices/triangle_shape.h>
#include <haptic_sculpt/surface/connectivity/star.h>

namespace haptic_sculpt::internal {

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

/// Whether no two neighbouring triangles of a star with its vertex at p have normals a right angle or more apart. As
/// CGAL does, relaxation leaves vertices where they have: they are on a crease, or the rim of a plate, which has no
/// tangent plane. Constrained edges may be creases: `is_crease(i)` says so of the edge to link[i].
template <class Mesh, class Is_crease>
bool is_smooth_at(const Star<Mesh>& star, const Coordinates& p, const Is_crease& is_crease) {
  const std::size_t n = star.valence();
  const auto normal = [&](std::size_t i) {
    return area_normal(p, star.link_points[star.next(i)], star.link_points[i]);
  };
  Vector last = normal(n - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const Vector next = normal(i);
    if (!point_alike(last, next) && !is_crease(i))
      return false;
    last = next;
  }
  return true;
}

/// Whether triangles abc and bad may become adc and dbc: no normal turns over, no sliver is made, and, as CGAL asks,
/// the product of the two normals, as long as the areas, does not shrink: so no crease is cut off. If it is not wanted
/// for other reasons it has to make a sliver better.
inline bool shape_permits_flip(const Vector& a, const Vector& b, const Vector& c, const Vector& d, bool is_wanted) {
  const double least_before = smaller(least_angle_measure(a, b, c), least_angle_measure(b, a, d)),
               least_after = smaller(least_angle_measure(a, d, c), least_angle_measure(d, b, c));
  const bool was_sliver = least_before < least_wanted_angle;
  if (was_sliver ? least_after <= least_before : !is_wanted || least_after < least_wanted_angle)
    return false;
  const Vector abc = area_normal(a, b, c), bad = area_normal(b, a, d), mean = plus(abc, bad),
               first = area_normal(a, d, c), second = area_normal(d, b, c);
  return quick_dot(first, second) >= quick_dot(abc, bad) && point_alike(first, second) && point_alike(mean, first) &&
         point_alike(mean, second);
}

/// The mean of the neighbours of a vertex at p, put back into the tangent plane.
template <class Mesh>
Coordinates relaxed_place(const Star<Mesh>& star, const Coordinates& p) {
  Vector mean{}, normal{};
  for (std::size_t i = 0; i < star.valence(); ++i) {
    mean = plus(mean, minus(star.link_points[i], p));
    normal = plus(normal, area_normal(p, star.link_points[star.next(i)], star.link_points[i]));
  }
  mean = scaled(mean, 1.0 / static_cast<double>(star.valence()));
  const double square = quick_dot(normal, normal);
  return plus(p, square > 0 ? quick_sum(mean, -quick_dot(mean, normal) / square, normal) : mean);
}

} // namespace haptic_sculpt::internal
