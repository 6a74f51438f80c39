// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sculpting/response/convex_scenes.h"

namespace haptic_sculpt::test {

/// An ulp of the largest coordinate of the scene and the target.
inline double ulp_of(const Mesh& mesh, const Point_3& target) {
  double largest = haptic_sculpt::internal::largest_magnitude({target.x(), target.y(), target.z()});
  for (const Vertex_index v : mesh.vertices())
    largest = std::fmax(largest, haptic_sculpt::internal::largest_magnitude(vertex_coordinates(mesh, v)));
  return internal::unit_in_the_last_place(largest);
}

inline Rational_point rational(const Point_3& p) { return rational(std::array<double, 3>{p.x(), p.y(), p.z()}); }

/// The distance of an end from the unique optimum, and whether that is as small as promised: 0.1 c and 4 ulp; at the
/// default clearance, which is a few ulp, 2 c over the least singular value of the normals that determine the optimum.
struct Optimum_check {
  double error = 0;
  std::size_t planes = 0;           ///< that push; 0: the target keeps the clearance itself
  double least_singular_value = 1;  ///< of their normals
  bool is_right = true;

  Optimum_check(const Convex_scene& scene, const Point_3& position, const Point_3& target, double c, bool is_default) {
    const Offset_half_spaces permitted(scene.half_spaces, c);
    const auto optimum = permitted.nearest({target.x(), target.y(), target.z()});
    error = distance(optimum.point, rational(position));
    planes = optimum.active.size();
    if (planes == 0) {
      is_right = position == target;
      return;
    }
    least_singular_value = permitted.least_singular_value(optimum.active);
    is_right = is_default ? error <= 2 * c / least_singular_value : error <= 0.1 * c + 4 * ulp_of(scene.mesh, target);
  }
};

inline bool is_beyond_no_plane(const Convex_scene& scene, const Point_3& p) {
  return Offset_half_spaces(scene.half_spaces, 0).contains(rational(p));
}

} // namespace haptic_sculpt::test
