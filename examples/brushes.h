// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_BRUSHES_H
#define HAPTIC_SCULPT_EXAMPLES_BRUSHES_H

/// \file
/// Brushes: each fills a map with targets for move_vertices(), which makes the dab without a self-intersection.

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/Surface_mesh.h>

#include <boost/property_map/property_map.hpp>

#include <cmath>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

namespace brushes {

enum class Kind {
  grab,    ///< along `direction`, by `strength` as a length
  inflate, ///< along each vertex's normal, by `strength` as a length
  smooth,  ///< towards the mean of the neighbours, by the share `strength`
  flatten, ///< onto the plane through the mean of what is touched, across `direction`, by the share `strength`
  pinch    ///< towards the line through the centre along `direction`, by the share `strength`
};

/// "grab", "inflate", "smooth", "flatten", "pinch", or nothing.
inline std::optional<Kind> kind_named(const std::string& name) {
  const char* const names[] = {"grab", "inflate", "smooth", "flatten", "pinch"};
  for (int i = 0; i < 5; ++i)
    if (name == names[i])
      return static_cast<Kind>(i);
  return std::nullopt;
}

template <class Kernel>
struct Dab {
  Kind kind;
  typename Kernel::Point_3 centre;
  double radius, strength;                                 ///< the effect falls off to nothing at the radius
  std::optional<typename Kernel::Vector_3> direction = {}; ///< any length; the mean normal where none is given
};

/// Multiplied by the power of two that brings its largest coordinate to about 1: squares and products of what is
/// measured in metres or in light years are doubles then. Zero for zero.
template <class Vector_3>
Vector_3 of_size_one(const Vector_3& v) {
  const double size = std::fmax(std::fabs(v.x()), std::fmax(std::fabs(v.y()), std::fabs(v.z())));
  if (!(size > 0) || !std::isfinite(size))
    return v;
  const int exponent = -std::ilogb(size);
  return {std::ldexp(v.x(), exponent), std::ldexp(v.y(), exponent), std::ldexp(v.z(), exponent)};
}

/// Unit length; zero for zero.
template <class Vector_3>
Vector_3 unit(const Vector_3& v) {
  const Vector_3 direction = of_size_one(v);
  const double length = std::sqrt(direction.squared_length());
  return length > 0 ? direction / length : v;
}

/// The same dab on the other side of a plane.
template <class Kernel>
Dab<Kernel> mirrored(Dab<Kernel> dab, const typename Kernel::Plane_3& plane) {
  const auto n = unit(plane.orthogonal_vector());
  const auto reflect = [&](const typename Kernel::Vector_3& v) { return v - 2 * (v * n) * n; };
  const auto foot = dab.centre - ((dab.centre - plane.point()) * n) * n;
  dab.centre = foot + reflect(dab.centre - foot);
  if (dab.direction)
    dab.direction = reflect(*dab.direction);
  return dab;
}

template <class Mesh>
auto normal(const Mesh& mesh, typename Mesh::Vertex_index v) {
  double size = 0; // of the star; all its edges are multiplied alike
  for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v))) {
    const auto edge = mesh.point(mesh.source(h)) - mesh.point(v);
    size = std::fmax(size, std::fmax(std::fabs(edge.x()), std::fmax(std::fabs(edge.y()), std::fabs(edge.z()))));
  }
  const int exponent = size > 0 ? -std::ilogb(size) : 0;
  const auto edge_to = [&](typename Mesh::Vertex_index w) {
    const auto edge = mesh.point(w) - mesh.point(v);
    return decltype(edge)(std::ldexp(edge.x(), exponent), std::ldexp(edge.y(), exponent),
                          std::ldexp(edge.z(), exponent));
  };
  auto sum = mesh.point(v) - mesh.point(v);
  for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v)))
    sum = sum + CGAL::cross_product(edge_to(mesh.source(h)), edge_to(mesh.target(mesh.next(h))));
  return unit(-sum);
}

/// The square of how far a point is from the centre of a dab, in its radii.
template <class Kernel>
double squared_share(const typename Kernel::Point_3& p, const Dab<Kernel>& dab) {
  const auto d = p - dab.centre;
  const double x = d.x() / dab.radius, y = d.y() / dab.radius, z = d.z() / dab.radius;
  return x * x + y * y + z * z;
}

/// The vertices within the radius that are connected to `nearest`: not those on the other side of a thin wall. Cost:
/// that of what is touched. \pre nearest has faces
template <class Mesh, class Kernel>
std::vector<typename Mesh::Vertex_index> touched(const Mesh& mesh, const Dab<Kernel>& dab,
                                                 typename Mesh::Vertex_index nearest) {
  using Vertex_index = typename Mesh::Vertex_index;
  const auto is_within = [&](Vertex_index v) { return squared_share(mesh.point(v), dab) < 1; };
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

/// The same from the vertex nearest to the centre, which is looked for among all.
template <class Mesh, class Kernel>
std::vector<typename Mesh::Vertex_index> touched(const Mesh& mesh, const Dab<Kernel>& dab) {
  using Vertex_index = typename Mesh::Vertex_index;
  const auto distance = [&](Vertex_index v) { return squared_share(mesh.point(v), dab); };
  Vertex_index nearest;
  for (const Vertex_index v : mesh.vertices())
    if (!mesh.is_isolated(v) && (!nearest.is_valid() || distance(v) < distance(nearest)))
      nearest = v;
  return nearest.is_valid() ? touched(mesh, dab, nearest) : std::vector<Vertex_index>();
}

/// Writes where a dab wants the vertices that it touches.
/// \param targets a writable map from vertices to points
/// \param mask a readable map from vertices to how much they take part, from 0 to 1
template <class Mesh, class Kernel, class Target_map, class Mask_map>
void fill_targets_of(const std::vector<typename Mesh::Vertex_index>& vertices, const Mesh& mesh, const Dab<Kernel>& dab,
                     Target_map targets, const Mask_map& mask) {
  using Vector_3 = typename Kernel::Vector_3;
  const auto weight = [&](typename Mesh::Vertex_index v) {
    const double square = squared_share(mesh.point(v), dab);
    return (1 - square) * (1 - square) * get(mask, v);
  };
  Vector_3 direction = CGAL::NULL_VECTOR, mean = CGAL::NULL_VECTOR;
  double sum = 0;
  for (const auto v : vertices) {
    direction = direction + weight(v) * normal(mesh, v);
    mean = mean + weight(v) * (mesh.point(v) - dab.centre);
    sum += weight(v);
  }
  direction = unit(dab.direction.value_or(direction));
  mean = sum > 0 ? mean / sum : mean;
  const auto wanted = [&](typename Mesh::Vertex_index v) -> Vector_3 {
    const Vector_3 from_centre = mesh.point(v) - dab.centre;
    switch (dab.kind) {
    case Kind::grab:
      return direction;
    case Kind::inflate:
      return normal(mesh, v);
    case Kind::flatten:
      return -((from_centre - mean) * direction) * direction;
    case Kind::pinch:
      return (from_centre * direction) * direction - from_centre;
    default: {
      Vector_3 to_mean = CGAL::NULL_VECTOR;
      for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v)))
        to_mean = to_mean + (mesh.point(mesh.source(h)) - mesh.point(v)) / mesh.degree(v);
      return to_mean;
    }
    }
  };
  for (const auto v : vertices)
    put(targets, v, mesh.point(v) + dab.strength * weight(v) * wanted(v));
}

/// The same, and returns what it touches.
template <class Mesh, class Kernel, class Target_map, class Mask_map>
std::vector<typename Mesh::Vertex_index> fill_targets(const Mesh& mesh, const Dab<Kernel>& dab, Target_map targets,
                                                      const Mask_map& mask) {
  const auto vertices = touched(mesh, dab);
  fill_targets_of(vertices, mesh, dab, targets, mask);
  return vertices;
}

/// Nothing is masked.
template <class Mesh, class Kernel, class Target_map>
std::vector<typename Mesh::Vertex_index> fill_targets(const Mesh& mesh, const Dab<Kernel>& dab, Target_map targets) {
  return fill_targets(mesh, dab, targets, boost::static_property_map<double, typename Mesh::Vertex_index>(1.0));
}

} // namespace brushes

#endif
