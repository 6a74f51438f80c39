// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace haptic_sculpt::internal {

/// Rounded; by halves, for the difference of two doubles may overflow.
inline double distance_between(const Decision_kernel::Point_3& p, const Decision_kernel::Point_3& q) {
  return 2 * std::hypot(p.x() / 2 - q.x() / 2, p.y() / 2 - q.y() / 2, p.z() / 2 - q.z() / 2);
}

/// Where points have gone. CGAL's functions renumber as they like, so a point is known by its place: at most one starts
/// from each.
class Trail {
public:
  using Point = Decision_kernel::Point_3;
  using Move = std::pair<Point, Point>; ///< from, to

  /// The distinct points of the faces. O(n log n).
  explicit Trail(const Face_soup& soup) {
    start_.reserve(soup.points.size());
    std::vector<bool> used(soup.points.size(), false);
    for (const auto corner : soup.corners)
      used[corner] = true;
    for (std::size_t v = 0; v < used.size(); ++v)
      if (used[v])
        start_.push_back(soup.points[v]);
    std::sort(start_.begin(), start_.end());
    start_.erase(std::unique(start_.begin(), start_.end()), start_.end());
    now_.assign(start_.begin(), start_.end());
  }

  /// Points go on from where they are. One with several moves takes the farthest from where it started; one with none
  /// is gone. \return the largest distance of the moves. O(n log n)
  double follow(std::vector<Move> moves) {
    double farthest = 0;
    for (const Move& move : moves)
      farthest = std::max(farthest, distance_between(move.first, move.second));
    const auto less = [](const Move& a, const Move& b) { return a.first < b.first; };
    std::sort(moves.begin(), moves.end(), less);
    for (std::size_t i = 0; i < now_.size(); ++i) {
      if (!now_[i])
        continue;
      const auto [begin, end] = std::equal_range(moves.begin(), moves.end(), Move(*now_[i], *now_[i]), less);
      now_[i].reset();
      for (auto move = begin; move != end; ++move)
        if (!now_[i] || distance_between(start_[i], *now_[i]) < distance_between(start_[i], move->second))
          now_[i] = move->second;
    }
    return farthest;
  }
  /// Points stay; those that are at none of these are gone.
  void keep(const std::vector<Point>& points) {
    std::vector<Move> moves;
    moves.reserve(points.size());
    for (const Point& p : points)
      moves.emplace_back(p, p);
    follow(std::move(moves));
  }

  std::size_t size() const { return start_.size(); }

  /// The largest distance of a point from where it started.
  double moved() const {
    double farthest = 0;
    for (std::size_t i = 0; i < now_.size(); ++i)
      if (now_[i])
        farthest = std::max(farthest, distance_between(start_[i], *now_[i]));
    return farthest;
  }

  /// Where those started that are gone.
  std::vector<Point> removed() const {
    std::vector<Point> gone;
    for (std::size_t i = 0; i < now_.size(); ++i)
      if (!now_[i])
        gone.push_back(start_[i]);
    return gone;
  }

  /// How many of these are at no point's place.
  std::size_t number_of_new(const std::vector<Point>& points) const {
    std::vector<Point> known;
    for (const auto& p : now_)
      if (p)
        known.push_back(*p);
    std::sort(known.begin(), known.end());
    return static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](const Point& p) {
      return !std::binary_search(known.begin(), known.end(), p);
    }));
  }

private:
  std::vector<Point> start_;
  std::vector<std::optional<Point>> now_;
};

} // namespace haptic_sculpt::internal
