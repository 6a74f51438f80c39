// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_STAR_FILTER_H
#define HAPTIC_SCULPT_SURFACE_STAR_FILTER_H

#include <haptic_sculpt/surface/broad_phase/Cone_of_boxes.h>
#include <haptic_sculpt/surface/broad_phase/Slab_of_points.h>

namespace haptic_sculpt {
namespace internal {

/// Which boxes of a node may meet what a star sweeps: those in the box around it, in the cone from its start to the
/// target, in that from the end back to the start, in the cone from its link to where its centre is, and in two slabs
/// around all; where these are thin.
class Star_filter {
public:
  explicit Star_filter(const Swept_star_3& star) {
    Box_3 link, around = star.path();
    for (std::size_t i = 0; i < star.valence; ++i)
      link.include(star.link[i]);
    if (star.valence != 0)
      from_link_ = Cone_of_boxes(link, around, 1);
    if (!star.is_box) {
      from_start_ = Cone_of_boxes(Box_3(link).include(star.source), Box_3(star.target), star.until);
      from_end_ = Cone_of_boxes(Box_3(link).include(star.target), Box_3(star.source), 1);
      if (from_link_.is_long() || from_start_.is_long() || from_end_.is_long())
        make_slabs(star);
    }
    around_ = Float_box::query(around.include(link));
  }

  unsigned meeting(const Box_node& node) const {
    unsigned mask = node.meeting(around_);
    if (mask != 0 && from_start_.is_long())
      mask &= from_start_.meeting(node);
    if (mask != 0 && from_end_.is_long())
      mask &= from_end_.meeting(node);
    if (mask != 0 && from_link_.is_long())
      mask &= from_link_.meeting(node);
    for (const Slab_of_points& slab : slabs_)
      if (mask != 0 && slab.is_thin())
        mask &= slab.meeting(node);
    return mask;
  }

  /// Whether there is more to it than the box.
  bool is_thin() const { return from_start_.is_long() || from_end_.is_long() || from_link_.is_long(); }
  const Float_box& box() const { return around_; }

private:
  Cone_of_boxes from_start_, from_end_, from_link_;
  std::array<Slab_of_points, 2> slabs_;
  Float_box around_;

  /// One about the plane of the source, the target and a point of the link, the other across it and along the line of
  /// the source and that point.
  void make_slabs(const Swept_star_3& star) {
    using Vector = Slab_of_points::Vector;
    if (star.valence == 0)
      return;
    Vector along{}, beside{};
    for (int i = 0; i < 3; ++i)
      along[i] = star.source[i] - star.link[0][i], beside[i] = star.target[i] - star.link[0][i];
    const auto cross = [](const Vector& a, const Vector& b) {
      return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const Vector normal = cross(along, beside);
    slabs_ = {Slab_of_points(star, normal), Slab_of_points(star, cross(normal, along))};
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
