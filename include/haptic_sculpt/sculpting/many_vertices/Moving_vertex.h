// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Sculptor.h>
#include <haptic_sculpt/sculpting/geometry/vector_3.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

namespace haptic_sculpt::internal {

/// A vertex and where it is to go.
template <class Mesh>
struct Moving_vertex {
  typename Mesh::Vertex_index vertex;
  Coordinates source, target;
};

/// No pass is made for less than this share of what was asked, as a sum of distances: to the origin there is no end of
/// coming nearer.
inline constexpr double least_left = 0x1p-100;

/// Between two points; where squares would leave the range of doubles, in another unit.
inline double distance(const Coordinates& p, const Coordinates& q) {
  const Vector d = minus(p, q);
  const double square = quick_dot(d, d);
  if (square > 0x1p-900 && square < 0x1p900)
    return std::sqrt(square);
  const double unit = unit_of(quick_magnitude(d));
  const Vector e = scaled(d, unit);
  return std::sqrt(quick_dot(e, e)) / unit;
}

/// How far vertices are from their targets, as a sum. \param place `place(v)`, where one is now
/// \param farthest no target was farther when the call began. Sums of one call are in one unit: they are compared.
template <class Mesh, class Place>
double sum_of_distances(const std::vector<Moving_vertex<Mesh>>& vertices, Place place, double farthest) {
  // A mesh has fewer than 2^32 vertices, so that no sum overflows in either unit.
  const double unit = farthest > 0x1p900 ? 0x1p-64 : 1;
  double sum = 0;
  for (const Moving_vertex<Mesh>& v : vertices)
    sum += unit * distance(place(v), v.target);
  return sum;
}

/// Vertices and their targets, each once, all read before anything moves. \param target_of `target_of(v)`, a point
/// \throw Unknown_vertex, Out_of_range
template <class Mesh, class Vertex_range, class Target_of>
std::vector<Moving_vertex<Mesh>> moving_vertices(const Mesh& mesh, const Vertex_range& vertices,
                                                 Target_of target_of) {
  std::vector<Moving_vertex<Mesh>> moving;
  std::vector<bool> is_given(mesh.num_vertices(), false);
  for (const typename Mesh::Vertex_index v : vertices) {
    check_vertex(mesh, v);
    if (is_given[static_cast<std::size_t>(v)])
      continue;
    is_given[static_cast<std::size_t>(v)] = true;
    const Coordinates target = coordinates(target_of(v));
    if (!is_in_range(target))
      throw_out_of_range("the target of vertex " + std::to_string(static_cast<std::size_t>(v)), target);
    moving.push_back({v, vertex_coordinates(mesh, v), target});
  }
  return moving;
}

} // namespace haptic_sculpt::internal
