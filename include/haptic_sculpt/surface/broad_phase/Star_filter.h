// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/broad_phase/Box_scale.h>
#include <haptic_sculpt/surface/broad_phase/Cone_of_boxes.h>
#include <haptic_sculpt/surface/broad_phase/Slab_of_points.h>

namespace haptic_sculpt::internal {

/// Which boxes of a node may meet what a star sweeps: those in the box around it, in the cone from its start to the
/// target, in that from the end back to the start, in the cone from its link to where its centre is, and in two slabs
/// around all; where these are thin.
///
/// Whether a box passes depends on that box and the star alone, and a box that contains one that passes passes too, as
/// rounded: what is asked is made of operations that round monotonically. So which boxes pass does not depend on what
/// tree they are in (doc/proofs/broad_phase.md, "Which faces count").
class Star_filter {
public:
  /// \param scale of the boxes \pre the star stays as it is while it is asked
  Star_filter(const Swept_star_3& star, const Box_scale& scale) : star_(&star), scale_(scale) {
    Box_3 link, around = star.path();
    for (std::size_t i = 0; i < star.valence; ++i)
      link.include(star.link[i]);
    if (star.valence != 0)
      from_link_ = Cone_of_boxes(scale(link), scale(around), 1);
    if (!star.is_box) {
      const Box_3 start = scale(Box_3(link).include(star.source));
      from_start_ = Cone_of_boxes(start, Box_3(scale(star.target)), star.until);
      from_end_ = Cone_of_boxes(scale(Box_3(link).include(star.target)), Box_3(scale(star.source)), 1);
      make_slabs(start);
    }
    has_cones_ = from_start_.is_long() || from_end_.is_long() || from_link_.is_long();
    around_ = scale.query(around.include(link));
  }

  unsigned meeting(const Box_node& node) const {
    unsigned mask = node.meeting(around_);
    if (mask != 0 && has_cones_) { // a box costs less to ask
      if (from_start_.is_long())
        mask &= from_start_.meeting(node);
      if (mask != 0 && from_end_.is_long())
        mask &= from_end_.meeting(node);
      if (mask != 0 && from_link_.is_long())
        mask &= from_link_.meeting(node);
    }
    for (const Slab_of_points& slab : slabs_)
      if (mask != 0 && slab.is_thin())
        mask &= slab.meeting(node);
    return mask;
  }

  /// Boxes of doubles which, rounded outward to floats, pass meet this closed box: to ask a broad phase that knows
  /// doubles.
  Box_3 holding_what_passes() const {
    Box_3 result;
    for (int i = 0; i < 3; ++i)
      result.lower[i] = -above_all(-around_.lower[i]), result.upper[i] = above_all(around_.upper[i]);
    return result;
  }

private:
  const Swept_star_3* star_;
  Box_scale scale_;
  Cone_of_boxes from_start_, from_end_, from_link_;
  std::array<Slab_of_points, 2> slabs_;
  Float_box around_;
  bool has_cones_ = false;

  /// Not below any double that Box_scale::below() takes to this float or a smaller one: two floats more are what the
  /// conversion and its correction take; all doubles where floats end.
  double above_all(float bound) const {
    constexpr double largest = std::numeric_limits<double>::max();
    if (bound >= std::numeric_limits<float>::max())
      return largest;
    const double above = -double{next_down(next_down(-bound))} / scale_.factor();
    return above < largest ? std::nextafter(above, largest) : largest;
  }

  /// One about the plane of the source, the target and a point of the link, the other across it and along the line of
  /// the source and that point. One that is not much thinner than the star at its start cuts little off the cones.
  void make_slabs(const Box_3& start) {
    using Vector = Slab_of_points::Vector;
    if (star_->valence == 0)
      return;
    double extent = 0;
    for (int i = 0; i < 3; ++i)
      extent = std::fmax(extent, start.upper[i] - start.lower[i]);
    const bool goes_there = star_->target == star_->link[0]; // as where an edge collapses: no plane would be known
    const Vector source = scale_(star_->source), target = scale_(star_->target),
                 point = scale_(star_->link[goes_there && star_->valence > 1 ? 1 : 0]);
    Vector along{}, beside{};
    for (int i = 0; i < 3; ++i)
      along[i] = source[i] - point[i], beside[i] = target[i] - point[i];
    const auto cross = [](const Vector& a, const Vector& b) {
      return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const Vector normal = cross(along, beside);
    slabs_ = {Slab_of_points(*star_, scale_, normal, extent / 8),
              Slab_of_points(*star_, scale_, cross(normal, along), extent / 8)};
  }
};

} // namespace haptic_sculpt::internal
