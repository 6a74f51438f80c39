// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_FINDING_AND_PLACING_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_FINDING_AND_PLACING_H

#include <haptic_sculpt/sculpting.h>

#include <Eigen/Core>

/// \file
/// How the tool finds vertices and puts its probe somewhere, in the vectors of the device.

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

/// The vertex with faces that is nearest to p, not farther than `within`; the null index where there is none.
template <class Sculptor>
typename Sculptor::Vertex_index nearest_vertex(Sculptor& sculptor, const Eigen::Vector3d& p, double within) {
  return sculptor.nearest_vertex(point_of<typename Sculptor::Point>(p), within);
}

/// Puts an isolated vertex to p. Returns false where that is refused: on a face, or inside of a solid.
template <class Sculptor>
bool put_probe(Sculptor& sculptor, typename Sculptor::Vertex_index probe, const Eigen::Vector3d& p) {
  return static_cast<bool>(sculptor.place(probe, point_of<typename Sculptor::Point>(p)));
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
