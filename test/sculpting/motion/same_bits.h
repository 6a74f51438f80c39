// SPDX-License-Identifier: GPL-3.0-or-later
// Whether two results are the same to the bit.
#pragma once

#include "sculpting/Random_scene.h"

#include <cstring>

namespace haptic_sculpt::test {

inline bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }
inline bool same_bits(const Point_3& a, const Point_3& b) {
  return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y()) && same_bits(a.z(), b.z());
}
inline bool same_bits(const Point_3::R::Vector_3& a, const Point_3::R::Vector_3& b) {
  return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y()) && same_bits(a.z(), b.z());
}

inline bool same_bits(const Contact_3<Mesh>& a, const Contact_3<Mesh>& b) {
  return a.kind == b.kind && a.vertices == b.vertices && same_bits(a.normal, b.normal) &&
         same_bits(a.plane[0], b.plane[0]) && same_bits(a.plane[1], b.plane[1]) && same_bits(a.plane[2], b.plane[2]) &&
         a.is_flat == b.is_flat && a.location == b.location && a.side == b.side;
}

/// All but the work: that of a drag that takes the vertex anew is more.
inline bool same_bits(const Drag_result<Mesh>& a, const Drag_result<Mesh>& b) {
  return same_bits(a.position, b.position) && a.reached == b.reached && a.end == b.end && a.legs == b.legs &&
         same_bits(a.stop_error, b.stop_error) && same_bits(a.stop_error_along_path, b.stop_error_along_path) &&
         same_bits(a.kkt_residual, b.kkt_residual) &&
         std::equal(a.contacts.begin(), a.contacts.end(), b.contacts.begin(), b.contacts.end(),
                    [](const auto& x, const auto& y) { return same_bits(x, y); });
}

/// Also which elements there are.
inline bool same_bits(const Mesh& a, const Mesh& b) {
  if (a.num_vertices() != b.num_vertices() || a.num_faces() != b.num_faces())
    return false;
  for (const Vertex_index v : a.vertices())
    if (b.is_removed(v) || !same_bits(a.point(v), b.point(v)))
      return false;
  for (const auto f : a.faces())
    if (b.is_removed(f) || internal::corners_of_face(a, f) != internal::corners_of_face(b, f))
      return false;
  return true;
}

} // namespace haptic_sculpt::test
