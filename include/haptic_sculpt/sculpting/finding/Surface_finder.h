// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision.h>
#include <haptic_sculpt/sculpting/Surface_hit.h>
#include <haptic_sculpt/sculpting/finding/box_bounds.h>
#include <haptic_sculpt/sculpting/finding/compare_distances.h>
#include <haptic_sculpt/surface/connectivity/Face_corners.h>
#include <haptic_sculpt/surface/broad_phase/Broad_phase_base.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <optional>

namespace haptic_sculpt::internal {

/// Finds the vertex nearest to a point, and what of the surface a segment meets first. Exact; vertices without faces
/// are no part of the surface (doc/use/finding.md).
template <class Mesh, class Broad_phase>
class Surface_finder {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;
  using Hit = Surface_hit<Mesh>;

  Surface_finder(const Mesh& mesh, Broad_phase& broad_phase, const Face_corners<Mesh>& corners,
                 Filter_counters& counters)
      : mesh_(&mesh), broad_phase_(&broad_phase), corners_of_(&corners), counters_(&counters) {}

  /// The null index where none is within that distance, which may be infinite. Of several at the same distance that of
  /// the smallest index.
  Vertex_index nearest_vertex(const Coordinates& p, double within) {
    Vertex_index best;
    Coordinates best_point{};
    const double unit = scale().factor();
    double limit = (within * unit) * (within * unit) * (1 + Distance_bound::rounding);
    if (limit < least_limit) // else what is nearer still would be lost to underflow
      limit = least_limit;
    const auto visit = [&](Face_index f) {
      for (const Vertex_index v : (*corners_of_)(f)) {
        if (v == best)
          continue;
        const Coordinates q = vertex_coordinates(*mesh_, v);
        const double square = rounded_square(p, q, unit);
        if (square > limit) // certainly
          continue;
        const int order = best.is_valid()                       ? compare_distances(p, q, best_point, unit)
                          : compare_distance(p, q, within, unit) <= 0 ? -1
                                                                : 1;
        if (order > 0 || (order == 0 && best < v))
          continue;
        best = v;
        best_point = q;
        const double nearer = square * (1 + 2 * Distance_bound::rounding);
        limit = nearer < least_limit ? least_limit : nearer < limit ? nearer : limit;
      }
      return limit;
    };
    const Distance_bound bound(p, scale());
    broad_phase_->visit_nearest_first(box_around(p, within), bound, limit, visit);
    return best;
  }

  std::optional<Hit> first_hit(const Coordinates& source, const Coordinates& target) {
    std::optional<Impact> first;
    double limit = 1;
    const auto visit = [&](Face_index f) {
      const auto& corners = (*corners_of_)(f);
      const Sweep_points points = {source, target, vertex_coordinates(*mesh_, corners[0]),
                                   vertex_coordinates(*mesh_, corners[1]), vertex_coordinates(*mesh_, corners[2])};
      const Sweep_verdict verdict = vertex_face_verdict(points, *counters_);
      if (!verdict.hits)
        return limit;
      const int order = first ? compare_times(points, verdict, first->points, first->verdict, *counters_) : -1;
      // Of an embedded surface all that is met first is one vertex, or the inside of one edge or face.
      if (order < 0 || (order == 0 && f < first->face))
        first = Impact{f, points, verdict};
      if (order < 0)
        limit = std::fmin(1.0, filtered_time(points, verdict).second);
      return limit;
    };
    const Entry_bound bound(source, target, scale());
    broad_phase_->visit_nearest_first(Box_3(source).include(target), bound, limit, visit);
    if (!first)
      return std::nullopt;
    return hit(*first);
  }

private:
  struct Impact {
    Face_index face;
    Sweep_points points;
    Sweep_verdict verdict;
  };

  /// Squares below this are not told apart by their rounded values.
  static constexpr double least_limit = 0x1p-900;

  const Mesh* mesh_;
  Broad_phase* broad_phase_;
  const Face_corners<Mesh>* corners_of_;
  Filter_counters* counters_;

  const Box_scale& scale() const { return Broad_phase_access::scale(*broad_phase_); }

  static Box_3 box_around(const Coordinates& p, double within) {
    constexpr double largest = std::numeric_limits<double>::max();
    Box_3 box;
    for (int i = 0; i < 3; ++i) {
      box.lower[i] = std::fmax(-largest, std::nextafter(p[i] - within, -largest));
      box.upper[i] = std::fmin(largest, std::nextafter(p[i] + within, largest));
    }
    return box;
  }

  Hit hit(const Impact& impact) const {
    const auto& corners = (*corners_of_)(impact.face);
    Hit hit;
    hit.face = impact.face;
    const int location = static_cast<int>(impact.verdict.location); // the face, one of three edges, or of three corners
    if (location >= static_cast<int>(Triangle_location::vertex_a))
      hit.vertex = corners[location - static_cast<int>(Triangle_location::vertex_a)];
    else if (location >= static_cast<int>(Triangle_location::edge_ab)) {
      const int k = location - static_cast<int>(Triangle_location::edge_ab);
      hit.edge = mesh_->edge(mesh_->halfedge(corners[k], corners[(k + 1) % 3]));
    }
    hit.feature = hit.vertex.is_valid() ? Surface_feature::vertex
                  : hit.edge.is_valid() ? Surface_feature::edge
                                        : Surface_feature::face;
    const auto [earliest, latest] = enclosed_time(impact.points, impact.verdict);
    hit.time = earliest + (latest - earliest) / 2;
    const Coordinates& s = impact.points[0];
    const Coordinates& t = impact.points[1];
    const auto at = [&](int i) { return hit.time == 1 ? t[i] : s[i] + hit.time * (t[i] - s[i]); };
    hit.point = typename Mesh::Point(at(0), at(1), at(2));
    return hit;
  }
};

} // namespace haptic_sculpt::internal
