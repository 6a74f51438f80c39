// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/orientation_filter.h>
#include <haptic_sculpt/surface/connectivity/Face_corners.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <vector>

namespace haptic_sculpt::internal {

/// On which side of ab a ray along x passes that begins at p + (0, e, e^2) with an infinitely small e > 0; 0 only where
/// a and b are one point, seen along x. As First_face_along_x decides it (doc/proofs/validity.md, "What it meets").
template <class Counters>
int turn_along_x(const Coordinates& a, const Coordinates& b, const Coordinates& p, Counters& counters) {
  if (const int sign = orientation_2(a, b, p, 0, counters); sign != 0)
    return sign;
  if (a[2] != b[2])
    return a[2] > b[2] ? 1 : -1;
  return (b[1] > a[1]) - (b[1] < a[1]);
}

/// Whether p lies in an odd number of the components of a closed embedded surface: inside of a solid, not in its
/// cavities, whichever way normals point. Exact, with no special position. \pre p does not lie on the surface
/// \param faces working memory. Cost: the query of the box of a ray, and its answer.
template <class Mesh, class Broad_phase, class Counters>
bool is_inside(const Mesh& mesh, Broad_phase& broad_phase, const Coordinates& p, Counters& counters,
               std::vector<typename Mesh::Face_index>& faces) {
  Box_3 ray(p);
  ray.upper[0] = std::numeric_limits<double>::max();
  faces.clear();
  broad_phase.query(ray, faces);
  bool inside = false;
  for (const auto f : faces) {
    const auto corners = corners_of_face(mesh, f);
    const Coordinates a = vertex_coordinates(mesh, corners[0]), b = vertex_coordinates(mesh, corners[1]),
                      c = vertex_coordinates(mesh, corners[2]);
    const int side = orientation_2(a, b, c, 0, counters); // the sign of the normal's x
    inside ^= side != 0 && turn_along_x(a, b, p, counters) == side && turn_along_x(b, c, p, counters) == side &&
              turn_along_x(c, a, p, counters) == side && orientation_3(a, b, c, p, counters) == -side;
  }
  return inside;
}

} // namespace haptic_sculpt::internal
