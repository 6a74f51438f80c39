// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/unit_of.h>
#include <haptic_sculpt/sculpting.h>

#include <Eigen/Core>

/// \file
/// How the tool finds vertices and says where it creates, in the vectors of the device.

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

/// The nearest place that a Sculptor takes: from a large scene a few lengths lead beyond; a hand is refused.
inline Eigen::Vector3d within_range(const Eigen::Vector3d& p) {
  return p.cwiseMin(haptic_sculpt::largest_coordinate).cwiseMax(-haptic_sculpt::largest_coordinate);
}

/// The vertex that is nearest to p, not farther than `within`; the null index where there is none.
template <class Sculptor>
typename Sculptor::Vertex_index nearest_vertex(Sculptor& sculptor, const Eigen::Vector3d& p, double within) {
  return sculptor.nearest_vertex(point_of<typename Sculptor::Point>(p), within);
}

/// Nearer to an edge than this share of the face's altitude, a vertex is created on the edge: on the face it would
/// leave a sliver.
constexpr double edge_share = 0.05;

} // namespace internal

/// The creation at p on the face of three corners, or on an edge of it that is nearer than a 20th of the altitude.
template <class Sculptor>
Edit creation_at(const Sculptor& sculptor, const std::array<typename Sculptor::Vertex_index, 3>& face,
                          const Eigen::Vector3d& p) {
  const internal::Rounding_to_nearest rounding;
  Edit wanted = Edit::of(Edit_kind::insert_on_face, {sculptor.id(face[0]), sculptor.id(face[1]), sculptor.id(face[2])},
                         {p[0], p[1], p[2]});
  const auto place_of = [&](int i) { return internal::vector_of(sculptor.mesh().point(face[i])); };
  const Eigen::Vector3d corners[3] = {place_of(0), place_of(1), place_of(2)};
  // Products of four lengths: in a unit of the face's own.
  const double unit = internal::unit_of(std::fmax((corners[1] - corners[0]).template lpNorm<Eigen::Infinity>(),
                                                  (corners[2] - corners[0]).template lpNorm<Eigen::Infinity>()));
  const auto way = [unit](const Eigen::Vector3d& from, const Eigen::Vector3d& to) -> Eigen::Vector3d {
    return unit * (to - from);
  };
  const Eigen::Vector3d normal = way(corners[0], corners[1]).cross(way(corners[0], corners[2]));
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d &a = corners[(i + 1) % 3], &b = corners[(i + 2) % 3];
    if (way(a, b).cross(way(a, p)).dot(normal) < internal::edge_share * normal.squaredNorm()) {
      wanted.kind = Edit_kind::insert_on_edge;
      wanted.vertices = {wanted.vertices[(i + 1) % 3], wanted.vertices[(i + 2) % 3], 0};
      break;
    }
  }
  return wanted;
}

} // namespace haptic_sculpt
