// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_FACE_WITHIN_CLEARANCE_H
#define HAPTIC_SCULPT_SCULPTING_FACE_WITHIN_CLEARANCE_H

#include <haptic_sculpt/sculpting/contact/clearance.h>
#include <haptic_sculpt/sculpting/contact/is_within_distance.h>
#include <haptic_sculpt/sculpting/motion/vector_3.h>
#include <haptic_sculpt/surface/Face_corners.h>
#include <haptic_sculpt/surface/broad_phase/face_box.h>

#include <algorithm>
#include <vector>

namespace haptic_sculpt {
namespace internal {

/// The face of the lowest number that a point is on, or nearer to than the clearance there, decided exactly; the null
/// descriptor where there is none. \param largest_coordinate bounds those of the mesh
template <class Mesh, class Broad_phase>
typename Mesh::Face_index face_within_clearance(const Mesh& mesh, Broad_phase& broad_phase, const Coordinates& p,
                                                const Clearance_rule& rule, double largest_coordinate) {
  const double reach = largest_magnitude(p), clearance = rule.at(std::fmax(largest_coordinate, reach));
  Box_3 near(p);
  for (int i = 0; i < 3; ++i) {
    // One ulp more than the clearance, for the sums are rounded.
    near.lower[i] = std::nextafter(near.lower[i] - clearance, -std::numeric_limits<double>::infinity());
    near.upper[i] = std::nextafter(near.upper[i] + clearance, std::numeric_limits<double>::infinity());
  }
  std::vector<typename Mesh::Face_index> faces;
  broad_phase.query(near, faces);
  std::sort(faces.begin(), faces.end());
  for (const auto f : faces) {
    const auto corners = corners_of_face(mesh, f);
    const Coordinates a = vertex_coordinates(mesh, corners[0]), b = vertex_coordinates(mesh, corners[1]),
                      c = vertex_coordinates(mesh, corners[2]);
    const double there = std::fmax(std::fmax(reach, largest_magnitude(a)),
                                   std::fmax(largest_magnitude(b), largest_magnitude(c)));
    if (is_within_distance(p, a, b, c, rule.at(there)))
      return f;
  }
  return Mesh::null_face();
}

} // namespace internal
} // namespace haptic_sculpt

#endif
