// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/repair/Repair_parameters.h>
#include <haptic_sculpt/surface/repair/Trail.h>
#include <haptic_sculpt/surface/repair/soup_steps.h>
#include <haptic_sculpt/surface/validity/soup_connectivity.h>

#include <CGAL/box_intersection_d.h>

#include <array>
#include <map>

namespace haptic_sculpt::internal {

/// Points on open edges that are nearly equal become one, at the place of one of them.
class Gap_closer {
  using Point = Face_soup::Point_3;
  using Number = Exact_ring_number;

public:
  Gap_closer(Polygon_soup& soup, const Repair_parameters& parameters)
      : soup_(soup), spares_edges_(!parameters.gap_length), gap_(parameters.gap_length.value_or(0)) {
    if (spares_edges_)
      gap_ = default_gap();
  }

  /// O(n log^3 n + pairs of points nearer than the gap).
  Repair_step run(Trail& trail) {
    collect_edges();
    std::vector<Trail::Move> moves;
    std::size_t merged = 0;
    if (gap_ > 0) {
      Disjoint_sets sets(soup_.points.size());
      for_each_near_pair([&](std::size_t v, std::size_t w) {
        sets.unite(static_cast<std::uint32_t>(v), static_cast<std::uint32_t>(w));
      });
      for (std::size_t v = 0; v < soup_.points.size(); ++v) {
        const std::size_t first = sets.find(static_cast<std::uint32_t>(v));
        merged += first != v;
        moves.emplace_back(soup_.points[v], soup_.points[first]);
      }
    }
    Repair_step step{Repair_kind::close_gaps, {{"points on open edges merged with near ones", merged}}, 0, {}};
    if (merged > 0) {
      for (std::size_t v = 0; v < moves.size(); ++v)
        soup_.points[v] = moves[v].second;
      step.moved = trail.follow(std::move(moves));
    }
    return step;
  }

private:
  static Number squared_distance(const Point& p, const Point& q) {
    Number sum(0);
    for (int k = 0; k < 3; ++k) {
      const Number d = Number(p[k]) - Number(q[k]);
      sum = sum + d * d;
    }
    return sum;
  }

  double default_gap() const {
    if (soup_.points.empty())
      return 0;
    Point lower = soup_.points[0], upper = lower;
    for (const Point& p : soup_.points) {
      lower = Point(std::min(lower.x(), p.x()), std::min(lower.y(), p.y()), std::min(lower.z(), p.z()));
      upper = Point(std::max(upper.x(), p.x()), std::max(upper.y(), p.y()), std::max(upper.z(), p.z()));
    }
    return Repair_parameters::default_gap_share * distance_between(lower, upper);
  }

  // Which points have open edges, and all neighbours of these.
  void collect_edges() {
    std::map<std::pair<std::size_t, std::size_t>, int> uses;
    for (const auto& face : soup_.faces)
      for (std::size_t i = 0; i < face.size(); ++i)
        ++uses[std::minmax(face[i], face[(i + 1) % face.size()])];
    is_open_.assign(soup_.points.size(), false);
    for (const auto& [edge, number] : uses)
      if (number == 1)
        is_open_[edge.first] = is_open_[edge.second] = true;
    neighbours_.assign(soup_.points.size(), {});
    for (const auto& [edge, number] : uses) {
      if (is_open_[edge.first])
        neighbours_[edge.first].push_back(edge.second);
      if (is_open_[edge.second])
        neighbours_[edge.second].push_back(edge.first);
    }
  }

  template <class Function>
  void for_each_near_pair(const Function& function) const {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t,
                                                          CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;
    std::vector<Box> boxes;
    for (std::size_t v = 0; v < soup_.points.size(); ++v)
      if (is_open_[v]) { // half as wide would do: two boxes meet if their points are near, whatever is rounded
        const double reach = reach_at(v);
        std::array<double, 3> lower, upper;
        for (int k = 0; k < 3; ++k) {
          lower[k] = soup_.points[v][k] - reach;
          upper[k] = soup_.points[v][k] + reach;
        }
        boxes.emplace_back(CGAL::Bbox_3(lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]), v);
      }
    std::vector<const Box*> pointers;
    for (const Box& box : boxes)
      pointers.push_back(&box);
    const Number squared_gap = Number(gap_) * Number(gap_);
    CGAL::box_self_intersection_d(pointers.begin(), pointers.end(), [&](const Box* a, const Box* b) {
      const Number d = squared_distance(soup_.points[a->info()], soup_.points[b->info()]);
      if (d <= squared_gap && (!spares_edges_ || (spares_edges_at(a->info(), d) && spares_edges_at(b->info(), d))))
        function(a->info(), b->info());
    });
  }

  /// Farther away nothing is that v may become one with, where edges are spared: by one point far from all others the
  /// gap may be as long as a mesh.
  double reach_at(std::size_t v) const {
    double reach = gap_;
    if (spares_edges_)
      for (const std::size_t w : neighbours_[v])
        reach = std::min(reach, distance_between(soup_.points[v], soup_.points[w]));
    return reach;
  }

  bool spares_edges_at(std::size_t v, const Number& squared) const {
    constexpr int n = Repair_parameters::default_edges_per_gap;
    const auto is_longer = [&](std::size_t w) {
      return squared * Number(n * n) <= squared_distance(soup_.points[v], soup_.points[w]);
    };
    return std::all_of(neighbours_[v].begin(), neighbours_[v].end(), is_longer);
  }

  Polygon_soup& soup_;
  bool spares_edges_;
  double gap_;
  std::vector<bool> is_open_;
  std::vector<std::vector<std::size_t>> neighbours_; // of points with open edges
};

} // namespace haptic_sculpt::internal
