// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_COLLISION_FACE_VERTEX_SWEEP_3_H
#define HAPTIC_SCULPT_COLLISION_FACE_VERTEX_SWEEP_3_H

#include <haptic_sculpt/collision/Impact_3.h>
#include <haptic_sculpt/collision/arithmetic/sweep_decision.h>
#include <haptic_sculpt/collision/arithmetic/sweep_points.h>

#include <CGAL/assertions.h>

#include <optional>

namespace haptic_sculpt {

/// Does a face from the moving vertex to the edge `g`, `i` touch the point `a` while the vertex goes from `s` to `t`?
///
/// Exact for all finite doubles (the 1997 paper, 3.2.1, test III: tetrahedron stgi contains a). The tetrahedron may be flat. The time is 0
/// where `a` lies on gi.
/// \pre All coordinates are finite, and g != i.
/// Where the checks are compiled out, degenerate static features are still answered exactly, as the hulls they are.
/// Cost: constant; 4 orientation signs at most outside of flat cases. Counts filter failures in `*counters`, if given.
template <class K, class Counters = No_filter_counters>
class Face_vertex_sweep_3 {
public:
  using Point_3 = typename K::Point_3;
  using result_type = std::optional<Impact_3<K>>;

  explicit Face_vertex_sweep_3(Counters* counters = nullptr) : counters_(counters) {}

  /// The first impact, or nothing when the closed sets do not meet.
  result_type operator()(const Point_3& s, const Point_3& t, const Point_3& g, const Point_3& i, const Point_3& a) const {
    const internal::Sweep_points points = checked_points(s, t, g, i, a);
    const internal::Sweep_verdict verdict = decide(points);
    if (!verdict.hits)
      return std::nullopt;
    return Impact_3<K>(Impact_feature::face_vertex, points, verdict);
  }

  /// Whether the closed sets meet: the same answer as operator(), without building the impact.
  bool do_collide(const Point_3& s, const Point_3& t, const Point_3& g, const Point_3& i, const Point_3& a) const {
    return decide(checked_points(s, t, g, i, a)).hits;
  }

private:
  Counters* counters_;

  internal::Sweep_verdict decide(const internal::Sweep_points& points) const {
    Counters ignored;
    return internal::face_vertex_verdict(points, counters_ != nullptr ? *counters_ : ignored);
  }

  static internal::Sweep_points checked_points(const Point_3& s, const Point_3& t, const Point_3& g, const Point_3& i, const Point_3& a) {
    const internal::Sweep_points points = internal::sweep_points(s, t, g, i, a);
    CGAL_precondition(internal::are_finite(points));
    CGAL_precondition(g != i);
    return points;
  }
};

} // namespace haptic_sculpt

#endif
