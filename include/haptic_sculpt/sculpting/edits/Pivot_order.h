// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/geometry/vector_3.h>
#include <haptic_sculpt/surface/connectivity/star.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace haptic_sculpt::internal {

/// The neighbours that a vertex may be drawn into, best first: by the least altitude, relative to the longest edge,
/// among the triangles of the fan that would be left; equal ones in link order, from a given one on. A heuristic:
/// rounded numbers are good enough, as what is taken is proven.
///
/// The least of some triangles bounds that of all from above, so a fan is looked at only while its bound is the
/// largest. Cost: up to n^2 for all of n neighbours in turn; about n log n for the first.
template <class Mesh>
class Pivot_order {
public:
  /// \param first the place in the link where its order begins \pre the star stays as it is while it is asked
  void begin(const Star<Mesh>& star, std::size_t first) {
    star_ = &star, first_ = first;
    fans_.clear();
    for (std::size_t rank = 0; rank < star.valence(); ++rank)
      fans_.push_back({std::numeric_limits<double>::infinity(), rank, 1});
    std::make_heap(fans_.begin(), fans_.end());
  }

  void reserve(std::size_t usual_valence) { fans_.reserve(usual_valence); }

  /// The place in the link of the next best; nothing after the last.
  std::optional<std::size_t> next() {
    while (!fans_.empty()) {
      std::pop_heap(fans_.begin(), fans_.end());
      Fan& fan = fans_.back();
      if (fan.seen + 1 >= star_->valence()) {
        const std::size_t rank = fan.rank;
        fans_.pop_back();
        return place(rank);
      }
      fan.bound = std::fmin(fan.bound, relative_altitude(place(fan.rank), fan.seen++));
      std::push_heap(fans_.begin(), fans_.end());
    }
    return std::nullopt;
  }

private:
  struct Fan {
    double bound; ///< the least altitude among the triangles seen
    std::size_t rank, ///< of the pivot, from `first_` on
        seen;         ///< triangles
    bool operator<(const Fan& other) const {
      return bound < other.bound || (bound == other.bound && rank > other.rank);
    }
  };

  const Star<Mesh>* star_ = nullptr;
  std::size_t first_ = 0;
  std::vector<Fan> fans_; ///< a heap, kept to allocate no more

  std::size_t place(std::size_t rank) const { return (rank + first_) % star_->valence(); }

  /// Of triangle k of the fan of a pivot, to its longest edge.
  double relative_altitude(std::size_t pivot, std::size_t k) const {
    const std::size_t n = star_->valence();
    const auto &a = star_->link_points[pivot], &b = star_->link_points[(pivot + k) % n],
               &c = star_->link_points[(pivot + k + 1) % n];
    const Vector ab = minus(b, a), ac = minus(c, a), bc = minus(c, b);
    const double longest = std::fmax(length(ab), std::fmax(length(ac), length(bc)));
    return length(cross(scaled(ab, 1 / longest), scaled(ac, 1 / longest)));
  }
};

} // namespace haptic_sculpt::internal
