// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/many_vertices/Scaled_points.h>

#include <queue>

namespace haptic_sculpt::internal {

/// Edges by length. Those that have died, or have another length than when they were put in, are left out: their slots
/// may have been used again, and what is new is put in anew. An edge that was put in several times comes once.
template <class Mesh>
class Edge_queue {
public:
  using Edge_index = typename Mesh::Edge_index;

  struct Entry {
    double length; ///< squared, in the unit of the points
    Edge_index edge;
  };

  Edge_queue(const Mesh& mesh, const Scaled_points<Mesh>& points, bool longest_first)
      : mesh_(&mesh), points_(&points), sign_(longest_first ? 1 : -1) {}

  void push(Edge_index e, double squared_length) { queue_.push({sign_ * squared_length, e}); }

  /// The next one; its edge is the null index when there is none.
  Entry pop() {
    while (!queue_.empty()) {
      const Entry next = queue_.top();
      while (!queue_.empty() && queue_.top().edge == next.edge && queue_.top().length == next.length)
        queue_.pop();
      const double length = sign_ * next.length;
      if (!mesh_->is_removed(next.edge) && points_->squared_length(next.edge) == length)
        return {length, next.edge};
    }
    return {0, Edge_index()};
  }

private:
  struct Comes_later {
    bool operator()(const Entry& a, const Entry& b) const {
      return a.length != b.length ? a.length < b.length : b.edge < a.edge; // not as the standard library would have it
    }
  };

  const Mesh* mesh_;
  const Scaled_points<Mesh>* points_;
  double sign_;
  std::priority_queue<Entry, std::vector<Entry>, Comes_later> queue_;
};

} // namespace haptic_sculpt::internal
