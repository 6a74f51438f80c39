// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_COLLISION_VERTEX_FACE_SWEEP_3_H
#define HAPTIC_SCULPT_COLLISION_VERTEX_FACE_SWEEP_3_H

#include <haptic_sculpt/collision/Impact_3.h>
#include <haptic_sculpt/collision/arithmetic/sweep_decision.h>
#include <haptic_sculpt/collision/arithmetic/sweep_points.h>

#include <CGAL/assertions.h>

#include <optional>

namespace haptic_sculpt {

/// Does a vertex on its way from `s` to `t` touch the closed triangle `a`, `b`, `c`, and when first?
///
/// Exact for all finite doubles (the 1997 paper, 3.2.1, test I: segment st meets triangle abc). `s == t` is allowed: then the question is
/// whether the point lies in the triangle, and the time is 0.
/// Where a, b, c are collinear or coincide the answer is about their hull, exact as well.
/// \pre All coordinates are finite.
/// Cost: constant; 5 orientation signs at most outside of flat cases. Counts filter failures in `*counters`, if given.
template <class K, class Counters = No_filter_counters>
class Vertex_face_sweep_3 {
public:
  using Point_3 = typename K::Point_3;
  using result_type = std::optional<Impact_3<K>>;

  explicit Vertex_face_sweep_3(Counters* counters = nullptr) : counters_(counters) {}

  /// The first impact, or nothing when the closed sets do not meet.
  result_type operator()(const Point_3& s, const Point_3& t, const Point_3& a, const Point_3& b, const Point_3& c) const {
    const internal::Sweep_points points = checked_points(s, t, a, b, c);
    const internal::Sweep_verdict verdict = decide(points);
    if (!verdict.hits)
      return std::nullopt;
    return Impact_3<K>(Impact_feature::vertex_face, points, verdict);
  }

  /// Whether the closed sets meet: the same answer as operator(), without building the impact.
  bool do_collide(const Point_3& s, const Point_3& t, const Point_3& a, const Point_3& b, const Point_3& c) const {
    return decide(checked_points(s, t, a, b, c)).hits;
  }

private:
  Counters* counters_;

  internal::Sweep_verdict decide(const internal::Sweep_points& points) const {
    Counters ignored;
    return internal::vertex_face_verdict(points, counters_ != nullptr ? *counters_ : ignored);
  }

  static internal::Sweep_points checked_points(const Point_3& s, const Point_3& t, const Point_3& a, const Point_3& b, const Point_3& c) {
    const internal::Sweep_points points = internal::sweep_points(s, t, a, b, c);
    CGAL_precondition(internal::are_finite(points));
    return points;
  }
};

} // namespace haptic_sculpt

#endif
