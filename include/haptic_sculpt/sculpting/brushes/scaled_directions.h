// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>

#include <CGAL/Kernel/global_functions.h>

#include <cmath>

namespace haptic_sculpt {
namespace internal {

template <class Vector_3>
double largest_coordinate(const Vector_3& v) {
  return std::fmax(std::fabs(v.x()), std::fmax(std::fabs(v.y()), std::fabs(v.z())));
}

/// Times 2^exponent.
template <class Vector_3>
Vector_3 times_power_of_two(const Vector_3& v, int exponent) {
  return {std::ldexp(v.x(), exponent), std::ldexp(v.y(), exponent), std::ldexp(v.z(), exponent)};
}

/// The exponent that brings a size to [1, 2): squares and products of what is measured in metres or in light years are
/// doubles then. 0 for zero and for what is not finite.
inline int exponent_to_one(double size) {
  return size > 0 && std::isfinite(size) ? -std::ilogb(size) : 0;
}

/// Of length 1; zero for zero.
template <class Vector_3>
Vector_3 unit_vector(const Vector_3& v) {
  const Vector_3 direction = times_power_of_two(v, exponent_to_one(largest_coordinate(v)));
  const double length = std::sqrt(direction.squared_length());
  return length > 0 ? direction / length : v;
}

} // namespace internal

/// The normal of a vertex, of length 1: the sum of those of its faces by their areas. The same at all scales, which
/// that of CGAL is not: its squares leave the range of doubles. \pre v has faces
template <class Mesh>
auto vertex_normal(const Mesh& mesh, typename Mesh::Vertex_index v) {
  const internal::Rounding_to_nearest rounding;
  double size = 0; // of the star; all its edges are multiplied alike
  for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v)))
    size = std::fmax(size, internal::largest_coordinate(mesh.point(mesh.source(h)) - mesh.point(v)));
  const int exponent = internal::exponent_to_one(size);
  auto sum = mesh.point(v) - mesh.point(v);
  for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v)))
    if (!mesh.is_border(h))
      sum = sum - CGAL::cross_product(
                      internal::times_power_of_two(mesh.point(mesh.source(h)) - mesh.point(v), exponent),
                      internal::times_power_of_two(mesh.point(mesh.target(mesh.next(h))) - mesh.point(v), exponent));
  return internal::unit_vector(sum);
}

} // namespace haptic_sculpt
