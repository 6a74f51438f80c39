// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_CONE_OF_BOXES_H
#define HAPTIC_SCULPT_SURFACE_CONE_OF_BOXES_H

#include <haptic_sculpt/surface/Box_node.h>
#include <haptic_sculpt/surface/Swept_star_3.h>

#include <cmath>

namespace haptic_sculpt {
namespace internal {

/// All boxes (1 - t) B + t T, 0 <= t <= 1 or up to where only a part of the way counts, from the box B of a star at its start to
/// the target T.
///
/// It holds all that the star sweeps, for that is made of convex combinations of points of B with T. On long pushes it
/// is far thinner than one box around all. The proof that no rounding loses a box is in doc/broad_phase.md.
class Cone_of_boxes {
public:
  explicit Cone_of_boxes(const Swept_star_3& star) {
    Box_3 base(star.source);
    for (std::size_t i = 0; i < star.valence; ++i)
      base.include(star.link[i]);
    double extent = 0, way = 0;
    for (int i = 0; i < 3; ++i) {
      extent = std::fmax(extent, base.upper[i] - base.lower[i]);
      way = std::fmax(way, std::abs(star.target[i] - star.source[i]));
      restrict_time(i + 3, float_below(base.lower[i]), star.target[i] - base.lower[i], true);
      restrict_time(i, float_above(base.upper[i]), star.target[i] - base.upper[i], false);
    }
    is_long_ = way * star.until > extent;
    until_ = float_above(star.until);
  }

  /// Whether the way is longer than the star is wide.
  bool is_long() const { return is_long_; }

  /// Bit j is 0 only if no box of the cone meets box j of the node.
  ///
  /// For each axis (1 - t) B.lower + t T <= upper and (1 - t) B.upper + t T >= lower bound t from one side each; the
  /// times that all six leave, and [0, until], must not be empty.
  unsigned meeting(const Box_node& node) const {
    static constexpr int bits[8] = {1, 2, 4, 8, 16, 32, 64, 128};
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
    int mask = 0;
    for (int j = 0; j < 8; ++j)
      mask |= first[j] > last[j] + slack ? 0 : bits[j];
    return static_cast<unsigned>(mask);
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
    const Limit limit{bound, origin, static_cast<float>(1 / extent)};
    if ((extent > 0) == is_upper)
      last_[lasts_++] = limit;
    else
      first_[firsts_++] = limit;
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
