// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_COLLISION_AXIS_SWEEP_H
#define HAPTIC_SCULPT_COLLISION_AXIS_SWEEP_H

/// \file
/// Do two features meet while their corners move along one coordinate axis, each at its own speed?
///
/// In the projection that drops the axis nothing moves, and every determinant of the corners is affine in time. So all
/// is decided by signs of the input doubles at the two ends of the motion; see doc/proofs/axis_moves.md.

#include <haptic_sculpt/collision/arithmetic/orientation_filter.h>

namespace haptic_sculpt {
namespace internal {

/// Points at the two ends of a motion along one axis. \pre start and end differ in that coordinate alone.
template <std::size_t points>
struct Axis_motion {
  int axis; ///< 0, 1 or 2
  std::array<Coordinates, points> start, end;

  /// \param heights along the axis, at the end
  Axis_motion(int axis, const std::array<Coordinates, points>& start, const std::array<double, points>& heights)
    : axis(axis), start(start), end(start) {
    for (std::size_t i = 0; i < points; ++i)
      end[i][axis] = heights[i];
  }
};

/// Whether signs are all the same, and none of them 0.
class Equal_signs {
public:
  void add(int sign) {
    is_broken_ |= sign == 0 || sign * sign_ < 0;
    sign_ = sign;
    is_empty_ = false;
  }
  bool is_broken() const { return is_broken_; }
  /// Features of which nothing lies over the other never meet; else they do where a sign changes or vanishes.
  bool do_meet() const { return !is_empty_ && is_broken_; }

private:
  int sign_ = 0;
  bool is_broken_ = false, is_empty_ = true;
};

/// The decisions about the points of one motion, by index.
template <std::size_t points, class Counters>
class Axis_sweep {
public:
  Axis_sweep(const Axis_motion<points>& motion, Counters& counters) : m_(motion), counters_(counters) {}

  /// Whether point 0 lies in the closed triangle 1, 2, 3 at some time.
  bool do_vertex_and_face_meet() const {
    static_assert(points == 4, "a vertex and a face have four corners");
    const int side = seen(1, 2, 3), at_12 = seen(1, 2, 0), at_23 = seen(2, 3, 0), at_31 = seen(3, 1, 0);
    if (side != 0)
      return at_12 * side >= 0 && at_23 * side >= 0 && at_31 * side >= 0 && !keep_their_side();
    if (at_12 != 0 || at_23 != 0 || at_31 != 0)
      return false;
    const Plane plane = plane_of_all();
    Equal_signs signs;
    for (const auto& [p, q] : {std::pair<int, int>(1, 2), {2, 3}, {3, 1}})
      add_heights(plane, 0, p, q, 1, signs);
    return signs.do_meet();
  }

  /// Whether the closed segments 0, 1 and 2, 3 have a common point at some time.
  bool do_edges_meet() const {
    static_assert(points == 4, "two edges have four ends");
    const int at_2 = seen(0, 1, 2), at_3 = seen(0, 1, 3);
    if (at_2 * at_3 > 0)
      return false;
    const int at_0 = seen(2, 3, 0), at_1 = seen(2, 3, 1);
    if (at_0 * at_1 > 0)
      return false;
    if ((at_2 != 0 || at_3 != 0) && (at_0 != 0 || at_1 != 0)) // they are not parallel: one point is over one
      return !keep_their_side();
    const Plane plane = plane_of_all(); // all four signs are 0
    Equal_signs signs;
    for (int end = 0; end < 2; ++end) {
      add_heights(plane, end, 2, 3, 1, signs);
      add_heights(plane, 2 + end, 0, 1, -1, signs);
    }
    return signs.do_meet();
  }

  /// Whether points 0, 1, 2 lie on one line at some time.
  bool is_face_degenerate() const {
    if (seen(0, 1, 2) != 0)
      return false;
    const Plane plane = plane_of_all();
    const int at_start = orientation_2(m_.start[0], m_.start[1], m_.start[2], plane.dropped, counters_);
    return at_start == 0 || orientation_2(m_.end[0], m_.end[1], m_.end[2], plane.dropped, counters_) != at_start;
  }

private:
  /// How to look at a vertical plane: drop a coordinate so that `along` tells points apart that are not above one another.
  struct Plane {
    int along, dropped;
    int up; ///< the sign of orientation_2 of a point above a segment that goes along
  };

  const Axis_motion<points>& m_;
  Counters& counters_;

  /// In the projection along the axis, where nothing moves.
  int seen(int a, int b, int c) const {
    return orientation_2(m_.start[a], m_.start[b], m_.start[c], m_.axis, counters_);
  }

  /// Whether the volume of all four has one sign at both ends, and so between.
  bool keep_their_side() const {
    const int sign = orientation_3(m_.start[0], m_.start[1], m_.start[2], m_.start[3], counters_);
    return sign != 0 && orientation_3(m_.end[0], m_.end[1], m_.end[2], m_.end[3], counters_) == sign;
  }

  /// \pre all points are seen on one line
  Plane plane_of_all() const {
    const int i = (m_.axis + 1) % 3, j = (m_.axis + 2) % 3;
    for (std::size_t k = 1; k < points; ++k)
      if (m_.start[k][i] != m_.start[0][i])
        return {i, j, -1}; // orientation_2 without j looks at (axis, i)
    return {j, i, 1};      // without i at (j, axis)
  }

  /// The signs of the heights of v above the segment p, q where it is over it: one at each end, or two where the segment
  /// is vertical.
  void add_heights(const Plane& plane, int v, int p, int q, int factor, Equal_signs& signs) const {
    const double at = m_.start[v][plane.along], from = m_.start[p][plane.along], to = m_.start[q][plane.along];
    if (signs.is_broken() || (at < from && at < to) || (from < at && to < at))
      return;
    for (const auto* now : {&m_.start, &m_.end})
      if (from == to) {
        for (const int end : {p, q}) {
          const double height = (*now)[v][m_.axis], other = (*now)[end][m_.axis];
          signs.add(factor * ((height > other) - (height < other)));
        }
      } else {
        const int side = orientation_2((*now)[p], (*now)[q], (*now)[v], plane.dropped, counters_);
        signs.add(factor * plane.up * (from < to ? side : -side));
      }
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
