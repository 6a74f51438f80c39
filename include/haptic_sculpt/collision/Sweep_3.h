// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/collision/Impact_3.h>
#include <haptic_sculpt/collision/arithmetic/sweep_decision.h>
#include <haptic_sculpt/collision/arithmetic/Sweep_verdict.h>

#include <CGAL/assertions.h>

#include <optional>

namespace haptic_sculpt {

/// Do a moving and a still feature meet while a vertex goes from `s` to `t`, and when first? One of the three sweeps:
/// Vertex_face_sweep_3, Edge_edge_sweep_3 and Face_vertex_sweep_3 say what `a`, `b` and `c` are.
///
/// Exact for all finite doubles. `s == t` is allowed: then the question is whether the closed sets meet, and the time
/// is 0. \tparam feature which pair of features meets \tparam K a CGAL kernel with `FT` = double \tparam Counters where
/// filter failures are counted \tparam Mode sets the mode of rounding while it decides. Cost: constant; 5 orientation
/// signs at most outside of flat cases.
template <Impact_feature feature, class K, class Counters = No_filter_counters,
          class Mode = internal::Rounding_to_nearest>
class Sweep_3 {
public:
  using Point_3 = typename K::Point_3;            ///< of the kernel; its coordinates are doubles
  using result_type = std::optional<Impact_3<K>>; ///< of a call, by the name that CGAL's functors give it

  /// \param counters where to count, if anywhere; has to outlive this
  explicit Sweep_3(Counters* counters = nullptr) : counters_(counters) {}
  /// The same sweep that sets the mode of rounding in another way.
  template <class Other_mode>
  explicit Sweep_3(const Sweep_3<feature, K, Counters, Other_mode>& other) : counters_(other.counters()) {}
  Counters* counters() const { return counters_; } ///< where is counted; nullptr: nowhere

  /// The first impact, or nothing when the closed sets do not meet.
  /// \pre all coordinates are finite. An edge may be a point.
  result_type operator()(const Point_3& s, const Point_3& t, const Point_3& a, const Point_3& b,
                         const Point_3& c) const {
    [[maybe_unused]] const Mode rounding{};
    const internal::Sweep_points points = checked_points(s, t, a, b, c);
    const internal::Sweep_verdict verdict = decide(points);
    if (!verdict.hits)
      return std::nullopt;
    return Impact_3<K>(feature, points, verdict);
  }

  /// Whether the closed sets meet: the same answer as operator(), without building the impact.
  bool do_collide(const Point_3& s, const Point_3& t, const Point_3& a, const Point_3& b, const Point_3& c) const {
    [[maybe_unused]] const Mode rounding{};
    return decide(checked_points(s, t, a, b, c)).hits;
  }

private:
  Counters* counters_;

  internal::Sweep_verdict decide(const internal::Sweep_points& points) const {
    Counters ignored;
    Counters& counters = counters_ != nullptr ? *counters_ : ignored;
    if constexpr (feature == Impact_feature::vertex_face)
      return internal::vertex_face_verdict(points, counters);
    else if constexpr (feature == Impact_feature::edge_edge)
      return internal::edge_edge_verdict(points, counters);
    else
      return internal::face_vertex_verdict(points, counters);
  }

  static internal::Sweep_points checked_points(const Point_3& s, const Point_3& t, const Point_3& a, const Point_3& b,
                                               const Point_3& c) {
    const internal::Sweep_points points = internal::sweep_points(s, t, a, b, c);
    CGAL_precondition(internal::are_finite(points));
    return points;
  }
};

/// Does a vertex on its way from `s` to `t` touch the closed triangle `a`, `b`, `c`, and when first?
///
/// Exact for all finite doubles (the 1997 paper, 3.2.1, test I: segment st meets triangle abc). Where a, b, c are
/// collinear or coincide the answer is about their hull, exact as well.
template <class K, class Counters = No_filter_counters>
using Vertex_face_sweep_3 = Sweep_3<Impact_feature::vertex_face, K, Counters>;

/// Does an edge from the moving vertex to `a` touch the closed segment `b`, `c` while the vertex goes from `s` to `t`?
///
/// Exact for all finite doubles (the 1997 paper, 3.2.1, test II: triangle sta meets segment bc). s, t, a may coincide
/// or be collinear. The time is 0 where `a` itself lies on bc. b and c may be one point, too.
template <class K, class Counters = No_filter_counters>
using Edge_edge_sweep_3 = Sweep_3<Impact_feature::edge_edge, K, Counters>;

/// Does a face from the moving vertex to the edge `a`, `b` touch the point `c` while the vertex goes from `s` to `t`?
///
/// Exact for all finite doubles (the 1997 paper, 3.2.1, test III: tetrahedron stab contains c). The tetrahedron may be
/// flat. a and b may be one point. The time is 0 where `c` lies on ab.
template <class K, class Counters = No_filter_counters>
using Face_vertex_sweep_3 = Sweep_3<Impact_feature::face_vertex, K, Counters>;

} // namespace haptic_sculpt
