// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/Filter_counters.h>
#include <haptic_sculpt/collision/arithmetic/exact_integers.h>
#include <haptic_sculpt/sculpting/geometry/clearance.h>
#include <haptic_sculpt/sculpting/geometry/vector_3.h>
#include <haptic_sculpt/surface/connectivity/Face_corners.h>
#include <haptic_sculpt/surface/Box_3.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <CGAL/Interval_nt.h>

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

/// Whether p is at most `distance` from the closed triangle a, b, c: from a corner, from a side that it lies beside, or
/// from the face that it lies over. Each is a sign of integers without a division: of degree 2, 4 and 6.
///
/// Integers of n limbs have two bits more than differences need (exact_integers.h), so sums of three products of two
/// differences fit in 2n limbs, of four in 4n, and of six in 6n.
template <class Integer>
bool is_within_distance(const std::array<Integer, 3>& p, const std::array<std::array<Integer, 3>, 3>& corners,
                        const Integer& distance) {
  const auto minus = [](const std::array<Integer, 3>& x, const std::array<Integer, 3>& y) {
    return std::array<Integer, 3>{x[0] - y[0], x[1] - y[1], x[2] - y[2]};
  };
  const auto dot = [](const auto& x, const auto& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; };
  const auto cross = [](const auto& x, const auto& y) {
    using Product = decltype(x[0] * y[0]);
    return std::array<Product, 3>{x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
  };
  const auto square = distance * distance;
  const auto normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
  bool is_over_face = sign_of(dot(normal, normal)) != 0; // within an undo of several steps a face may have no area
  for (int i = 0; i < 3; ++i) {
    const auto from_corner = minus(p, corners[i]), side = minus(corners[(i + 1) % 3], corners[i]);
    const auto beyond = dot(from_corner, from_corner) - square;
    if (sign_of(beyond) <= 0)
      return true;
    const auto along = dot(from_corner, side), length = dot(side, side);
    // Off the line by |from_corner|^2 - along^2 / length.
    if (sign_of(along) > 0 && sign_of(length - along) > 0 && sign_of(beyond * length - along * along) <= 0)
      return true;
    is_over_face = is_over_face && sign_of(dot(normal, cross(side, from_corner))) >= 0;
  }
  if (!is_over_face)
    return false;
  const auto height = dot(normal, minus(p, corners[0])); // times |normal|
  return sign_of(height * height - square * dot(normal, normal)) <= 0;
}

/// The same of doubles; exact, over integers where p is as near to the plane of the triangle, or intervals cannot tell.
/// Allocates only where these are more than 2^199 apart in size. \pre a, b, c not collinear
inline bool is_within_distance(const Coordinates& p, const Coordinates& a, const Coordinates& b, const Coordinates& c,
                               double distance) {
  if (is_surely_off_plane(p, a, b, c, distance))
    return false;
  Exponent_range range;
  for (const Coordinates* q : {&p, &a, &b, &c})
    range.include(*q);
  range.include(distance);
  No_filter_counters uncounted;
  return with_exact_integers(range, uncounted, [&](auto type) {
    using Integer = decltype(type);
    const auto integers = [&](const Coordinates& q) { return to_integers<Integer>(q, range.lowest); };
    return is_within_distance<Integer>(integers(p), {integers(a), integers(b), integers(c)},
                                       Integer_of_double<Integer>::convert(distance, range.lowest));
  });
}

/// A face on which p lies, or that is not farther from it than the clearance there; of several that of the smallest
/// index, the null index where there is none. Exact. \param largest_coordinate bounds those of all vertices
/// \param faces working memory
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
