// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_BRUSH_TARGETS_H
#define HAPTIC_SCULPT_SCULPTING_BRUSH_TARGETS_H

#include <haptic_sculpt/sculpting/brushes/Brush_dab.h>

#include <CGAL/Kernel/global_functions.h>

#include <boost/property_map/property_map.hpp>

#include <unordered_set>
#include <vector>

namespace haptic_sculpt {
namespace internal {

/// Of the faces around a vertex, by their areas; of length 1, or zero.
template <class Mesh>
auto star_normal(const Mesh& mesh, typename Mesh::Vertex_index v) {
  const auto p = mesh.point(v);
  double size = 0; // of the star; all its edges are multiplied alike
  for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v))) {
    const auto edge = mesh.point(mesh.source(h)) - p;
    size = std::fmax(size, std::fmax(std::fabs(edge.x()), std::fmax(std::fabs(edge.y()), std::fabs(edge.z()))));
  }
  const double unit = unit_of(size);
  auto sum = p - p;
  for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v)))
    sum = sum + CGAL::cross_product((mesh.point(mesh.target(mesh.next(h))) - p) * unit, (mesh.point(mesh.source(h)) - p) * unit);
  return unit_vector(sum);
}

/// The square of how far a point is from the centre of a dab, in its radii.
template <class Kernel>
double squared_share(const typename Kernel::Point_3& p, const Brush_dab<Kernel>& dab) {
  const auto d = p - dab.centre;
  const double x = d.x() / dab.radius, y = d.y() / dab.radius, z = d.z() / dab.radius;
  return x * x + y * y + z * z;
}

/// By how much a dab wants each of the vertices moved, in their order.
template <class Mesh, class Kernel, class Mask_map>
std::vector<typename Kernel::Vector_3> brush_ways(const std::vector<typename Mesh::Vertex_index>& vertices, const Mesh& mesh,
                                                  const Brush_dab<Kernel>& dab, const Mask_map& mask) {
  using Vector_3 = typename Kernel::Vector_3;
  std::vector<double> weights;
  double sum = 0;
  for (const auto v : vertices) {
    const double rest = 1 - squared_share(mesh.point(v), dab);
    weights.push_back(rest * rest * get(mask, v));
    sum += weights.back();
  }
  Vector_3 direction = dab.direction.value_or(CGAL::NULL_VECTOR), mean = CGAL::NULL_VECTOR;
  const bool has_axis = dab.kind != Brush_kind::inflate && dab.kind != Brush_kind::smooth;
  for (std::size_t k = 0; has_axis && k < vertices.size(); ++k) {
    if (!dab.direction)
      direction = direction + weights[k] * star_normal(mesh, vertices[k]);
    mean = mean + weights[k] * (mesh.point(vertices[k]) - dab.centre);
  }
  direction = unit_vector(direction);
  mean = sum > 0 ? mean / sum : mean;
  const auto wanted = [&](typename Mesh::Vertex_index v) -> Vector_3 {
    const Vector_3 from_centre = mesh.point(v) - dab.centre;
    switch (dab.kind) {
    case Brush_kind::grab:
      return direction;
    case Brush_kind::inflate:
      return star_normal(mesh, v);
    case Brush_kind::flatten:
      return -((from_centre - mean) * direction) * direction;
    case Brush_kind::pinch:
      return (from_centre * direction) * direction - from_centre;
    default: {
      Vector_3 to_mean = CGAL::NULL_VECTOR;
      const double valence = mesh.degree(v);
      for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v)))
        to_mean = to_mean + (mesh.point(mesh.source(h)) - mesh.point(v)) / valence;
      return to_mean;
    }
    }
  };
  std::vector<Vector_3> ways;
  for (std::size_t k = 0; k < vertices.size(); ++k)
    ways.push_back(dab.strength * weights[k] * wanted(vertices[k]));
  return ways;
}

} // namespace internal

/// The vertices within the radius that are connected to `nearest` by such: not those on the other side of a thin wall.
/// \pre nearest has faces. Cost: that of what is touched.
template <class Mesh, class Kernel>
std::vector<typename Mesh::Vertex_index> touched_vertices(const Mesh& mesh, const Brush_dab<Kernel>& dab,
                                                          typename Mesh::Vertex_index nearest) {
  using Vertex_index = typename Mesh::Vertex_index;
  const internal::Rounding_to_nearest rounding;
  const auto is_within = [&](Vertex_index v) { return internal::squared_share(mesh.point(v), dab) < 1; };
  std::vector<Vertex_index> result;
  if (!is_within(nearest))
    return result;
  std::unordered_set<Vertex_index> met = {nearest};
  result.push_back(nearest);
  for (std::size_t i = 0; i < result.size(); ++i)
    for (const auto h : mesh.halfedges_around_target(mesh.halfedge(result[i])))
      if (const Vertex_index w = mesh.source(h); is_within(w) && met.insert(w).second)
        result.push_back(w);
  return result;
}

/// The same from the vertex nearest to the centre, which is looked for among all: where there is a Sculptor, ask its
/// nearest_vertex(). Cost: linear in the mesh.
template <class Mesh, class Kernel>
std::vector<typename Mesh::Vertex_index> touched_vertices(const Mesh& mesh, const Brush_dab<Kernel>& dab) {
  using Vertex_index = typename Mesh::Vertex_index;
  const internal::Rounding_to_nearest rounding;
  const auto distance = [&](Vertex_index v) { return internal::squared_share(mesh.point(v), dab); };
  Vertex_index nearest;
  for (const Vertex_index v : mesh.vertices())
    if (!mesh.is_isolated(v) && (!nearest.is_valid() || distance(v) < distance(nearest)))
      nearest = v;
  return nearest.is_valid() ? touched_vertices(mesh, dab, nearest) : std::vector<Vertex_index>();
}

/// Writes where a dab wants the vertices that it touches. Changes nothing else: what is done with the targets is the
/// caller's affair, and apply_brush() does it under the guard.
///
/// \param targets a writable map from vertices to points
/// \param mask a readable map from vertices to how much they take part, from 0 to 1
template <class Mesh, class Kernel, class Target_map,
          class Mask_map = boost::static_property_map<double, typename Mesh::Vertex_index>>
void fill_brush_targets(const std::vector<typename Mesh::Vertex_index>& vertices, const Mesh& mesh, const Brush_dab<Kernel>& dab,
                        Target_map targets, const Mask_map& mask = Mask_map(1.0)) {
  const internal::Rounding_to_nearest rounding;
  const auto ways = internal::brush_ways(vertices, mesh, dab, mask);
  for (std::size_t k = 0; k < vertices.size(); ++k)
    put(targets, vertices[k], mesh.point(vertices[k]) + ways[k]);
}

} // namespace haptic_sculpt

#endif
