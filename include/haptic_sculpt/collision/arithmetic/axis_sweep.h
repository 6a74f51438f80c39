// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Do two features meet while their corners move along one coordinate axis, each at its own speed?
///
/// In the projection that drops the axis nothing moves, and every determinant of the corners is affine in time. So all
/// is decided by signs of the input doubles at the two ends of the motion; see doc/proofs/axis_moves.md.

#include <haptic_sculpt/collision/arithmetic/orientation_filter.h>

#include <initializer_list>

namespace haptic_sculpt::internal {

/// A point that moves along an axis: the coordinates after that of the axis, in cyclic order, which do not change; that
/// along the axis at the start, and at the end. So whatever the axis is, it is the last one here; a cyclic change
/// of coordinates keeps the signs of all determinants.
using Axis_place = std::array<double, 4>;

/// Points in a motion along one axis.
template <std::size_t points>
struct Axis_motion {
  std::array<Axis_place, points> places;

  explicit Axis_motion(const std::array<Axis_place, points>& places) : places(places) {}
  /// \param axis 0, 1 or 2 \param heights along the axis, at the end
  Axis_motion(int axis, const std::array<Coordinates, points>& start, const std::array<double, points>& heights) {
    for (std::size_t i = 0; i < points; ++i)
      places[i] = {start[i][(axis + 1) % 3], start[i][(axis + 2) % 3], start[i][axis], heights[i]};
  }

  Coordinates start(std::size_t i) const { return {places[i][0], places[i][1], places[i][2]}; }
  Coordinates end(std::size_t i) const { return {places[i][0], places[i][1], places[i][3]}; }

  bool are_finite() const {
    bool result = true;
    for (const Axis_place& p : places)
      for (const double x : p)
        result = result && std::isfinite(x);
    return result;
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

/// The decisions about points of one motion, by index. Those of one decision need not differ.
template <std::size_t points, class Counters>
class Axis_sweep {
public:
  Axis_sweep(const Axis_motion<points>& motion, Counters& counters) : m_(motion), counters_(counters) {}

  /// Whether point v lies in the closed triangle a, b, c at some time.
  bool do_vertex_and_face_meet(int v, int a, int b, int c) const {
    return do_vertex_and_face_meet(v, a, b, c, seen(a, b, c), by_itself());
  }
  /// The same. \param side of the triangle, as seen \param sign as seen(), of an edge of the triangle and the point
  template <class Sign>
  bool do_vertex_and_face_meet(int v, int a, int b, int c, int side, const Sign& sign) const {
    if (side != 0)
      return sign(a, b, v) * side >= 0 && sign(b, c, v) * side >= 0 && sign(c, a, v) * side >= 0 &&
             !keep_their_side(a, b, c, v);
    if (sign(a, b, v) != 0 || sign(b, c, v) != 0 || sign(c, a, v) != 0)
      return false;
    const Plane plane = plane_of(v, {a, b, c});
    Equal_signs signs;
    add_heights(plane, v, a, b, 1, signs);
    add_heights(plane, v, b, c, 1, signs);
    add_heights(plane, v, c, a, 1, signs);
    return signs.do_meet();
  }

  /// Whether the closed segments a, b and c, d have a common point at some time.
  bool do_edges_meet(int a, int b, int c, int d) const { return do_edges_meet(a, b, c, d, by_itself()); }
  /// The same. \param sign as seen(), of one edge and an end of the other
  template <class Sign>
  bool do_edges_meet(int a, int b, int c, int d, const Sign& sign) const {
    const int at_c = sign(a, b, c), at_d = sign(a, b, d);
    if (at_c * at_d > 0)
      return false;
    const int at_a = sign(c, d, a), at_b = sign(c, d, b);
    if (at_a * at_b > 0)
      return false;
    if ((at_c != 0 || at_d != 0) && (at_a != 0 || at_b != 0)) // they are not parallel: one point is over one
      return !keep_their_side(a, b, c, d);
    const Plane plane = plane_of(a, {b, c, d}); // all four signs are 0
    Equal_signs signs;
    add_heights(plane, a, c, d, 1, signs);
    add_heights(plane, b, c, d, 1, signs);
    add_heights(plane, c, a, b, -1, signs);
    add_heights(plane, d, a, b, -1, signs);
    return signs.do_meet();
  }

  /// Whether points a, b, c lie on one line at some time.
  bool is_face_degenerate(int a, int b, int c) const {
    if (seen(a, b, c) != 0)
      return false;
    const Plane plane = plane_of(a, {b, c});
    const int at_start = orientation_2(m_.start(a), m_.start(b), m_.start(c), plane.dropped, counters_);
    return at_start == 0 || orientation_2(m_.end(a), m_.end(b), m_.end(c), plane.dropped, counters_) != at_start;
  }

  /// The orientation of a, b, c in the projection along the axis, where nothing moves.
  int seen(int a, int b, int c) const {
    const Axis_place &p = m_.places[a], &q = m_.places[b], &r = m_.places[c];
    const Enclosed_determinant determinant = enclosed_determinant_2(q[0] - p[0], q[1] - p[1], r[0] - p[0], r[1] - p[1]);
    return determinant.is_certain() ? determinant.sign()
                                    : exact_orientation_2(m_.start(a), m_.start(b), m_.start(c), along, counters_);
  }

  /// Whether the projections of the triangles f, f + 1, f + 2 and g, g + 1, g + 2 are certainly apart: an edge of the
  /// first has all of the second strictly beyond it. Then no features of theirs meet. \param side the first as seen, or
  /// 0 \param sign as seen(), of an edge of the first and a corner of the second
  template <class Sign>
  static bool is_seen_beside(int side, int f, int g, const Sign& sign) {
    for (int i = 0; i < 3 && side != 0; ++i) {
      const int a = f + i, b = f + (i + 1) % 3;
      if (sign(a, b, g) * side < 0 && sign(a, b, g + 1) * side < 0 && sign(a, b, g + 2) * side < 0)
        return true;
    }
    return false;
  }

private:
  static constexpr int along = 2; ///< the coordinate that changes

  /// How to look at a vertical plane: drop a coordinate so that `along` tells points apart that are not above one
  /// another.
  struct Plane {
    int along, dropped;
    int up; ///< the sign of orientation_2 of a point above a segment that goes along
  };

  const Axis_motion<points>& m_;
  Counters& counters_;

  auto by_itself() const {
    return [this](int a, int b, int c) { return seen(a, b, c); };
  }

  /// Whether the volume of all four has one sign at both ends, and so between.
  bool keep_their_side(int a, int b, int c, int d) const {
    const int sign = orientation_3(m_.start(a), m_.start(b), m_.start(c), m_.start(d), counters_);
    return sign != 0 && orientation_3(m_.end(a), m_.end(b), m_.end(c), m_.end(d), counters_) == sign;
  }

  /// \pre all points given are seen on one line
  Plane plane_of(int first, std::initializer_list<int> others) const {
    for (const int k : others)
      if (m_.places[k][0] != m_.places[first][0])
        return {0, 1, -1}; // orientation_2 without 1 looks at (along, 0)
    return {1, 0, 1};      // without 0 at (1, along)
  }

  /// The signs of the heights of v above the segment p, q where it is over it: one at each end, or two where the
  /// segment is vertical.
  void add_heights(const Plane& plane, int v, int p, int q, int factor, Equal_signs& signs) const {
    const double at = m_.places[v][plane.along], from = m_.places[p][plane.along], to = m_.places[q][plane.along];
    if (signs.is_broken() || (at < from && at < to) || (from < at && to < at))
      return;
    for (const int now : {along, along + 1}) { // at the start, at the end
      const auto point = [&](int k) -> Coordinates { return {m_.places[k][0], m_.places[k][1], m_.places[k][now]}; };
      if (from == to) {
        for (const int end : {p, q}) {
          const double height = m_.places[v][now], other = m_.places[end][now];
          signs.add(factor * ((height > other) - (height < other)));
        }
      } else {
        const int side = orientation_2(point(p), point(q), point(v), plane.dropped, counters_);
        signs.add(factor * plane.up * (from < to ? side : -side));
      }
    }
  }
};

} // namespace haptic_sculpt::internal
