// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Invalid_parameter.h>
#include <haptic_sculpt/sculpting/brushes/Dab_3.h>
#include <haptic_sculpt/surface/coordinate_range.h>

#include <boost/property_map/property_map.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace haptic_sculpt {

/// The vertices within the radius of a dab that are connected to `nearest`: not those on the other side of a thin wall.
/// Cost: that of what is touched, and clearing a bit for each vertex of the mesh. \pre nearest is in the mesh
template <class Mesh, class Kernel>
std::vector<typename Mesh::Vertex_index> touched_vertices(const Mesh& mesh, const Dab_3<Kernel>& dab,
                                                          typename Mesh::Vertex_index nearest) {
  using Vertex_index = typename Mesh::Vertex_index;
  const internal::Rounding_to_nearest rounding;
  const auto is_within = [&](Vertex_index v) { return dab.squared_share(mesh.point(v)) < 1; };
  std::vector<Vertex_index> result;
  std::vector<bool> is_met(mesh.num_vertices(), false);
  const auto meet = [&](Vertex_index v) {
    if (!is_met[v] && is_within(v))
      result.push_back(v);
    is_met[v] = true;
  };
  meet(nearest);
  for (std::size_t i = 0; i < result.size(); ++i)
    for (const auto h : mesh.halfedges_around_target(mesh.halfedge(result[i])))
      meet(mesh.source(h));
  return result;
}

/// The most that the strength of a dab may be, either way: 2^53 as a share; as a length 2^53 times what is the largest
/// of the radius and the coordinates of `nearest` and its neighbours. With more a vertex is to go where it would go
/// from anywhere, for the place where it is gets lost in rounding, and exact decisions take numbers of thousands of
/// bits. Cost: the valence. \pre nearest is in the mesh
template <class Mesh, class Kernel>
double largest_strength(const Mesh& mesh, const Dab_3<Kernel>& dab, typename Mesh::Vertex_index nearest) {
  const internal::Rounding_to_nearest rounding;
  constexpr double doubles_of_a_size = 0x1p53; // as many steps of a last place are in a double of this size, no unit
  if (dab.kind != Brush_kind::grab && dab.kind != Brush_kind::inflate)
    return doubles_of_a_size;
  double size = std::fmax(dab.radius, internal::largest_coordinate(mesh.point(nearest)));
  for (const auto h : mesh.halfedges_around_target(mesh.halfedge(nearest)))
    size = std::fmax(size, internal::largest_coordinate(mesh.point(mesh.source(h))));
  return doubles_of_a_size * size;
}

namespace internal {

/// \throw Out_of_range, Invalid_parameter
template <class Kernel>
void check_dab(const Dab_3<Kernel>& dab) {
  if (!(dab.radius >= 0))
    throw Invalid_parameter("the radius of a dab must be a length >= 0, not " + number(dab.radius));
  check_range("the radius of a dab", dab.radius);
  if (dab.direction && *dab.direction == CGAL::NULL_VECTOR)
    throw Invalid_parameter("the direction of a dab must not be 0; leave it out for the mean normal");
  if (dab.direction)
    for (const double x : {dab.direction->x(), dab.direction->y(), dab.direction->z()})
      check_range("the direction of a dab", x);
}

/// Calls `put(v, way)` with each vertex and how far a dab wants it to go.
template <class Mesh, class Kernel, class Mask_map, class Put>
void for_each_brush_way(const std::vector<typename Mesh::Vertex_index>& vertices, const Mesh& mesh,
                        const Dab_3<Kernel>& dab, const Mask_map& mask, bool inside_out, const Put& put) {
  using Vector_3 = typename Kernel::Vector_3;
  const auto weight = [&](typename Mesh::Vertex_index v) {
    const double square = dab.squared_share(mesh.point(v)), part = get(mask, v);
    if (!(part >= 0 && part <= 1))
      throw Invalid_parameter("the mask of vertex " + std::to_string(static_cast<std::size_t>(v)) +
                              " must be from 0 to 1, not " + number(part));
    return square < 1 ? (1 - square) * (1 - square) * part : 0; // it would grow again beyond the radius
  };
  const bool has_direction = dab.kind != Brush_kind::inflate && dab.kind != Brush_kind::smooth;
  Vector_3 direction = CGAL::NULL_VECTOR, mean = CGAL::NULL_VECTOR;
  double sum = 0;
  for (const auto v : vertices) {
    if (has_direction && !dab.direction)
      direction = direction + weight(v) * vertex_normal(mesh, v);
    mean = mean + weight(v) * (mesh.point(v) - dab.centre);
    sum += weight(v);
  }
  direction = unit_vector(dab.direction.value_or(direction));
  mean = sum > 0 ? mean / sum : mean;
  const auto wanted = [&](typename Mesh::Vertex_index v) -> Vector_3 {
    const Vector_3 from_centre = mesh.point(v) - dab.centre;
    switch (dab.kind) {
    case Brush_kind::grab:
      return direction;
    case Brush_kind::inflate:
      return inside_out ? -vertex_normal(mesh, v) : vertex_normal(mesh, v);
    case Brush_kind::flatten:
      return -((from_centre - mean) * direction) * direction;
    case Brush_kind::pinch:
      return (from_centre * direction) * direction - from_centre;
    default: {
      Vector_3 to_mean = CGAL::NULL_VECTOR;
      const auto valence = mesh.degree(v);
      for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v)))
        to_mean = to_mean + (mesh.point(mesh.source(h)) - mesh.point(v)) / valence;
      return to_mean;
    }
    }
  };
  for (const auto v : vertices) {
    const double w = weight(v);
    put(v, w == 0 ? Vector_3(CGAL::NULL_VECTOR) : dab.strength * w * wanted(v));
  }
}

/// Where a vertex at p is that goes a way; -0 stays where there is none.
template <class Point, class Vector>
Point gone(const Point& p, const Vector& way) {
  return way == CGAL::NULL_VECTOR ? p : p + way;
}

} // namespace internal

/// Where a dab wants these vertices: those that it does not touch, where they are.
/// \param targets a writable property map from vertices to points; is written for `vertices` only
/// \param mask a readable property map from vertices to how much they take part, from 0 to 1
/// \param inside_out whether the normals of the component point into the solid, as Sculptor::is_inside_out() says: a
/// dab that inflates goes the other way then
/// \throw Invalid_parameter where the mask is not from 0 to 1, the radius no length, or the direction 0; Out_of_range.
/// Cost: linear in the edges of `vertices`.
template <class Mesh, class Kernel, class Target_map, class Mask_map>
void fill_brush_targets(const std::vector<typename Mesh::Vertex_index>& vertices, const Mesh& mesh,
                        const Dab_3<Kernel>& dab, Target_map targets, const Mask_map& mask, bool inside_out = false) {
  const internal::Rounding_to_nearest rounding;
  internal::check_dab(dab);
  internal::for_each_brush_way(vertices, mesh, dab, mask, inside_out,
                               [&](auto v, const auto& way) { put(targets, v, internal::gone(mesh.point(v), way)); });
}

} // namespace haptic_sculpt
