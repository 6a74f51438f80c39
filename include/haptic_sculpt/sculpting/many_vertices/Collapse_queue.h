// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <queue>
#include <vector>

namespace haptic_sculpt::internal {

/// Edges by cost, the cheapest first, of equal ones the shortest, then the lowest. An edge that is put in anew has its
/// new cost only. A cost is a sum of squares, so less than 0 is 0 that was rounded: in a plane the rounding would
/// choose the edges, and draw hundreds into one vertex.
template <class Mesh>
class Collapse_queue {
public:
  using Edge_index = typename Mesh::Edge_index;

  struct Entry { // small: the time goes into moving them
    double cost, squared_length;
    Edge_index edge;
    std::uint32_t into_end : 1; // that the placement is refused is known: into the one end or the other
    std::uint32_t time : 31;    // which entry of the edge, counted from 1
  };

  /// \param unit a power of two by which lengths are multiplied, so that their squares stay in the range of doubles
  Collapse_queue(const Mesh& mesh, double unit) : mesh_(mesh), unit_(unit) {}

  void push(Edge_index e, double cost, bool into_end) {
    queue_.push({std::fmax(cost, 0), squared_length(e), e, into_end, ++time(e)});
  }
  void leave_out(Edge_index e) { ++time(e); }

  /// The next one, or nothing.
  std::optional<Entry> pop() {
    while (!queue_.empty()) {
      const Entry entry = queue_.top();
      queue_.pop();
      if (!mesh_.is_removed(entry.edge) && entry.time == time(entry.edge))
        return entry;
    }
    return std::nullopt;
  }

private:
  struct Comes_later {
    bool operator()(const Entry& a, const Entry& b) const {
      return a.cost != b.cost                       ? a.cost > b.cost
             : a.squared_length != b.squared_length ? a.squared_length > b.squared_length
                                                    : b.edge < a.edge;
    }
  };

  double squared_length(Edge_index e) const {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double way = unit_ * (mesh_.point(mesh_.vertex(e, 0))[k] - mesh_.point(mesh_.vertex(e, 1))[k]);
      sum += way * way;
    }
    return sum;
  }
  std::uint32_t& time(Edge_index e) {
    const auto i = static_cast<std::size_t>(e);
    if (i >= times_.size())
      times_.resize(i + 1, 0);
    return times_[i];
  }

  const Mesh& mesh_;
  double unit_;
  std::vector<std::uint32_t> times_;
  std::priority_queue<Entry, std::vector<Entry>, Comes_later> queue_;
};

} // namespace haptic_sculpt::internal
