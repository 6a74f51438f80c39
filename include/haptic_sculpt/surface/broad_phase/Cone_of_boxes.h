// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Box_3.h>
#include <haptic_sculpt/surface/broad_phase/Box_node.h>
#include <haptic_sculpt/to_float.h>

#include <cmath>

namespace haptic_sculpt::internal {

/// All boxes (1 - t) A + t B, 0 <= t <= until, between two boxes: up to `until` = 1 the convex hull of both, and more.
///
/// Where the boxes are far apart it is far thinner than one box around them. The proof that no rounding loses a box is
/// in doc/proofs/broad_phase.md.
class Cone_of_boxes {
public:
  Cone_of_boxes() = default; ///< everything

  Cone_of_boxes(const Box_3& a, const Box_3& b, double until) : until_(float_above(until)) {
    double extent = 0, way = 0;
    for (int i = 0; i < 3; ++i) {
      extent = std::fmax(extent, std::fmax(a.upper[i] - a.lower[i], b.upper[i] - b.lower[i]));
      way = std::fmax(way, std::fmax(std::abs(b.lower[i] - a.lower[i]), std::abs(b.upper[i] - a.upper[i])));
    }
    is_long_ = way * until > extent;
    for (int i = 0; i < 3 && is_long_; ++i) {
      restrict_time(i + 3, float_below(a.lower[i]), b.lower[i] - a.lower[i], true);
      restrict_time(i, float_above(a.upper[i]), b.upper[i] - a.upper[i], false);
    }
  }

  /// Whether it is longer than the boxes are wide: else it is no thinner than a box around both, and everything here.
  bool is_long() const { return is_long_; }

  /// Bit j is 0 only if no box of the cone meets box j of the node.
  ///
  /// For each axis (1 - t) A.lower + t B.lower <= upper and (1 - t) A.upper + t B.upper >= lower bound t from one side
  /// each; the times that all six leave, and [0, until], must not be empty.
  unsigned meeting(const Box_node& node) const {
    float first[8], last[8];
    for (int j = 0; j < 8; ++j)
      first[j] = 0, last[j] = until_;
    for (int k = 0; k < lasts_; ++k) {
      const Limit limit = last_[k];
      for (int j = 0; j < 8; ++j) {
        const float t = (node.bounds[limit.bound][j] - limit.origin) * limit.inverse;
        last[j] = t < last[j] ? t : last[j];
      }
    }
    for (int k = 0; k < firsts_; ++k) {
      const Limit limit = first_[k];
      for (int j = 0; j < 8; ++j) {
        const float t = (node.bounds[limit.bound][j] - limit.origin) * limit.inverse;
        first[j] = t > first[j] ? t : first[j];
      }
    }
    for (int j = 0; j < 8; ++j)
      last[j] += slack;
    return Eight_flags::greater(first, last).where_not();
  }

private:
  /// (bound - origin) * inverse is the first or last time left by that bound of a child's box.
  struct Limit {
    int bound; ///< which row of a node
    float origin, inverse;
  };

  /// Of t, which has no unit: twice what rounding can take off a bound of t on both sides.
  static constexpr float slack = 0x1p-18f;
  /// Extents out of this range restrict nothing, so that no inverse overflows or loses digits to underflow.
  static constexpr double least_extent = 0x1p-100, largest_extent = 0x1p+100;

  std::array<Limit, 6> first_, last_;
  int firsts_ = 0, lasts_ = 0;
  float until_ = 1;
  bool is_long_ = false;

  void restrict_time(int bound, float origin, double extent, bool is_upper) {
    if (!(std::abs(extent) >= least_extent && std::abs(extent) <= largest_extent))
      return;
    const Limit limit{bound, origin, to_float(1 / extent)};
    if ((extent > 0) == is_upper)
      last_[lasts_++] = limit;
    else
      first_[firsts_++] = limit;
  }
};

} // namespace haptic_sculpt::internal
