// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/exact_integers.h>
#include <haptic_sculpt/sculpting/Non_finite_point.h>
#include <haptic_sculpt/sculpting/Unknown_vertex.h>
#include <haptic_sculpt/surface/coordinate_range.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <cmath>
#include <string>

namespace haptic_sculpt::internal {

template <class Mesh>
void check_vertex(const Mesh& mesh, typename Mesh::Vertex_index v) {
  // is_valid() of a default-made index is false; the second test keeps is_removed() inside its array.
  if (!v.is_valid() || static_cast<std::size_t>(v) >= mesh.num_vertices() || mesh.is_removed(v))
    throw Unknown_vertex(static_cast<std::size_t>(v));
}

inline bool is_finite(const Coordinates& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

/// \throw Non_finite_point, Out_of_range
template <class Point_3>
void check_point(const char* what, const Point_3& p) {
  if (is_in_range(coordinates(p)))
    return;
  if (!is_finite(coordinates(p)))
    throw Non_finite_point(p);
  throw_out_of_range(what, coordinates(p));
}

enum class If_not_finite { refuse, leave }; ///< to who looks at the mesh after

/// Of all points of a mesh. \throw Out_of_range
template <class Mesh>
void check_points(const Mesh& mesh, If_not_finite then = If_not_finite::refuse) {
  for (const auto v : mesh.vertices())
    if (const Coordinates p = vertex_coordinates(mesh, v);
        !is_in_range(p) && (then == If_not_finite::refuse || is_finite(p)))
      throw_out_of_range("vertex " + std::to_string(static_cast<std::size_t>(v)) + " at", p);
}

} // namespace haptic_sculpt::internal
