// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/exact_integers.h>
#include <haptic_sculpt/sculpting/many_vertices/triangle_shape.h>
#include <haptic_sculpt/surface/connectivity/star.h>

namespace haptic_sculpt::internal {

/// Six times the volume between a star with its vertex at `from` and what it is once that has collapsed into vertex
/// `to` of the link, in cubes of a length: 0 within a plane and along a crease.
template <class Mesh>
double volume_of_collapse(const Star<Mesh>& star, const Coordinates& from, std::size_t to, double length) {
  double sum = 0;
  const Coordinates& target = star.link_points[to];
  const Vector way = minus(from, target);
  for (std::size_t i = 0; i < star.valence(); ++i)
    if (const std::size_t j = star.next(i); i != to && j != to)
      sum += std::fabs(quick_dot(area_normal(target, star.link_points[j], star.link_points[i]), way));
  return sum / length / length / length;
}

/// The collapse of the source of a halfedge into its target, and what it is worth.
template <class Halfedge_index>
struct Rated_collapse {
  Halfedge_index halfedge;
  double shape;  ///< shape_after_move(): of the triangles that it leaves, or -1
  double volume; ///< volume_of_collapse()

  /// More takes too much off a corner. The smaller this is, the nearer a remeshing is to its input, and the farther are
  /// its edges from the target length; with this neither is worse than what CGAL makes (doc/results/remeshing.md).
  static constexpr double most_volume = 0.8;
  /// If two volumes differ by less, the triangles decide.
  static constexpr double like_volume = 0.1;

  bool is_wanted() const { return shape >= 0 && volume <= most_volume; }
  bool is_better_than(const Rated_collapse& other) const {
    if (is_wanted() != other.is_wanted())
      return is_wanted();
    return std::fabs(volume - other.volume) > like_volume ? volume < other.volume : shape > other.shape;
  }
};

} // namespace haptic_sculpt::internal
