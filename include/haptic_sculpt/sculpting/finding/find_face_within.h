// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/exact_integers.h>
#include <haptic_sculpt/sculpting/geometry/clearance.h>
#include <haptic_sculpt/sculpting/geometry/vector_3.h>
#include <haptic_sculpt/surface/Face_corners.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <vector>

namespace haptic_sculpt::internal {

/// Whether intervals show that p is farther than `distance` from the plane of a, b, c. Allocates nothing.
inline bool is_surely_off_plane(const Coordinates& p, const Coordinates& a, const Coordinates& b, const Coordinates& c,
                                double distance) {
  using Interval = CGAL::Interval_nt<>;
  using Vector = std::array<Interval, 3>;
  const auto from_a = [&a](const Coordinates& q) {
    return Vector{Interval(q[0]) - a[0], Interval(q[1]) - a[1], Interval(q[2]) - a[2]};
  };
  const Vector u = from_a(b), v = from_a(c), w = from_a(p);
  const Vector n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const Interval height = n[0] * w[0] + n[1] * w[1] + n[2] * w[2]; // times |n|
  const Interval limit = CGAL::square(Interval(distance)) *
                         (CGAL::square(n[0]) + CGAL::square(n[1]) + CGAL::square(n[2]));
  return (CGAL::square(height) - limit).inf() > 0;
}

/// Whether p is at most `distance` from the closed triangle a, b, c; exact, over rationals where p is as near to its
/// plane, or intervals cannot tell. \pre a, b, c not collinear
inline bool is_within_distance(const Coordinates& p, const Coordinates& a, const Coordinates& b, const Coordinates& c,
                               double distance) {
  if (is_surely_off_plane(p, a, b, c, distance))
    return false;
  using Kernel = CGAL::Simple_cartesian<CGAL::Gmpq>;
  const auto point = [](const Coordinates& q) { return Kernel::Point_3(q[0], q[1], q[2]); };
  const CGAL::Gmpq limit(distance);
  return CGAL::compare(CGAL::squared_distance(point(p), Kernel::Triangle_3(point(a), point(b), point(c))),
                       CGAL::Gmpq(limit * limit)) != CGAL::LARGER;
}

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
