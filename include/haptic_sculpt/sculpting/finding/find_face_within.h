// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/geometry/clearance.h>
#include <haptic_sculpt/sculpting/geometry/is_within_distance.h>
#include <haptic_sculpt/sculpting/geometry/vector_3.h>
#include <haptic_sculpt/surface/Face_corners.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <algorithm>
#include <vector>

namespace haptic_sculpt::internal {

/// A face on which p lies, or that is nearer to it than the clearance there; of several that of the smallest index, the
/// null index where there is none. Exact. \param largest_coordinate bounds those of all vertices \param faces working
/// memory
template <class Mesh, class Broad_phase>
typename Mesh::Face_index find_face_within(const Mesh& mesh, Broad_phase& broad_phase, const Coordinates& p,
                                           const Clearance_rule& rule, double largest_coordinate,
                                           std::vector<typename Mesh::Face_index>& faces) {
  const double reach = largest_magnitude(p), clearance = rule.at(std::fmax(largest_coordinate, reach));
  Box_3 near(p);
  for (int i = 0; i < 3; ++i) {
    // One ulp more than the clearance, for the sums are rounded.
    near.lower[i] = std::nextafter(near.lower[i] - clearance, -std::numeric_limits<double>::infinity());
    near.upper[i] = std::nextafter(near.upper[i] + clearance, std::numeric_limits<double>::infinity());
  }
  faces.clear();
  broad_phase.query(near, faces);
  std::sort(faces.begin(), faces.end());
  for (const auto f : faces) {
    const auto corners = corners_of_face(mesh, f);
    const Coordinates a = vertex_coordinates(mesh, corners[0]), b = vertex_coordinates(mesh, corners[1]),
                      c = vertex_coordinates(mesh, corners[2]);
    const double there =
        std::fmax(std::fmax(reach, largest_magnitude(a)), std::fmax(largest_magnitude(b), largest_magnitude(c)));
    if (is_within_distance(p, a, b, c, rule.at(there)))
      return f;
  }
  return {};
}

} // namespace haptic_sculpt::internal
