// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_FINDING_AND_PLACING_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_FINDING_AND_PLACING_H

#include <haptic_sculpt/sculpting.h>

#include <Eigen/Core>

#include <cmath>
#include <type_traits>

/// \file
/// How the tool finds vertices and puts its probe somewhere: by the Sculptor where it can, else in a plain way.

namespace haptic_sculpt {
namespace internal {

template <class Point>
Eigen::Vector3d vector_of(const Point& p) {
  return {p.x(), p.y(), p.z()};
}
template <class Point>
Point point_of(const Eigen::Vector3d& v) {
  return Point(v[0], v[1], v[2]);
}

template <class Sculptor, class = void>
struct Finds_vertices : std::false_type {};
template <class Sculptor>
struct Finds_vertices<Sculptor, std::void_t<decltype(std::declval<Sculptor&>().nearest_vertex(
                                    std::declval<typename Sculptor::Point>(), 1.0))>> : std::true_type {};

template <class Sculptor, class = void>
struct Places_probes : std::false_type {};
template <class Sculptor>
struct Places_probes<Sculptor,
                     std::void_t<decltype(std::declval<Sculptor&>().place(
                         std::declval<typename Sculptor::Vertex_index>(), std::declval<typename Sculptor::Point>()))>>
    : std::true_type {};

/// The vertex with faces that is nearest to p, not farther than `within`; the null index where there is none.
template <class Sculptor>
typename Sculptor::Vertex_index nearest_vertex(Sculptor& sculptor, const Eigen::Vector3d& p, double within) {
  if constexpr (Finds_vertices<Sculptor>::value)
    return sculptor.nearest_vertex(point_of<typename Sculptor::Point>(p), within);
  else {
    const auto& mesh = sculptor.mesh();
    typename Sculptor::Vertex_index nearest;
    double least = within * within;
    for (const auto v : mesh.vertices()) {
      const double distance = (vector_of(mesh.point(v)) - p).squaredNorm();
      if (distance <= least && !mesh.is_isolated(v) && (distance < least || !nearest.is_valid()))
        least = distance, nearest = v;
    }
    return nearest;
  }
}

/// Puts an isolated vertex to p, or, where the Sculptor cannot do that, drags it there as far as it comes: it stays on
/// its side of the surface. \return whether it is where it may be used
template <class Sculptor>
bool put_probe(Sculptor& sculptor, typename Sculptor::Vertex_index probe, const Eigen::Vector3d& p) {
  const auto point = point_of<typename Sculptor::Point>(p);
  if constexpr (Places_probes<Sculptor>::value)
    return static_cast<bool>(sculptor.place(probe, point));
  else {
    auto grab = sculptor.grab(probe);
    grab.drag_to(point);
    return true;
  }
}

/// The sum of the normals of a vertex's faces, with their areas; of length 1, or 0.
template <class Mesh>
Eigen::Vector3d vertex_normal(const Mesh& mesh, typename Mesh::Vertex_index v) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d p = vector_of(mesh.point(v));
  for (const auto h : CGAL::halfedges_around_target(mesh.halfedge(v), mesh))
    sum += (vector_of(mesh.point(mesh.target(mesh.next(h)))) - p).cross(vector_of(mesh.point(mesh.source(h))) - p);
  return sum.stableNormalized();
}

} // namespace internal
} // namespace haptic_sculpt

#endif
