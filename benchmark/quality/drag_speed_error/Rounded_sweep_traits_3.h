// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "determinant_sweep.h"
#include "drag_speed_error/Arithmetic.h"
#include "oracle/sweep_oracle.h"
#include "paper_sweep.h"

#include <haptic_sculpt/collision.h>

#include <algorithm>

namespace haptic_sculpt::benchmark {

/// An impact as some arithmetic sees it: its time is the one that was computed, right or wrong.
template <class K>
class Rounded_impact_3 {
public:
  using Point_3 = typename K::Point_3;

  Rounded_impact_3(Impact_feature feature, const std::array<Point_3, 5>& points, double time)
      : points_(points), time_(time), feature_(feature) {}

  Impact_feature feature() const { return feature_; }
  Triangle_location location() const { return Triangle_location::face; }
  bool is_flat() const { return false; } // contact planes are found exactly, and say it themselves
  const Point_3& source() const { return points_[0]; }
  const Point_3& target() const { return points_[1]; }
  const Point_3& static_point(int i) const { return points_[static_cast<std::size_t>(2 + i)]; }
  std::pair<double, double> time() const { return {time_, time_}; }
  std::pair<double, double> time_bounds() const { return {time_, time_}; }
  mpq_class exact_time() const { return mpq_class(time_); }

private:
  std::array<Point_3, 5> points_;
  double time_;
  Impact_feature feature_;
};

/// One sweep, decided in the arithmetic of choice.
template <Impact_feature feature, class K>
class Rounded_sweep_3 {
public:
  using Point_3 = typename K::Point_3;

  explicit Rounded_sweep_3(Arithmetic arithmetic) : arithmetic_(arithmetic) {}

  std::optional<Rounded_impact_3<K>> operator()(const Point_3& s, const Point_3& t, const Point_3& a, const Point_3& b,
                                                const Point_3& c) const {
    const Sweep_answer answer = ask({s, t, a, b, c});
    if (!answer.hits)
      return std::nullopt;
    // What is no number, or outside of the way, has to be put on it somewhere.
    const double time = answer.time > 0 ? std::min(answer.time, 1.0) : 0;
    return Rounded_impact_3<K>(feature, {s, t, a, b, c}, time);
  }
  bool do_collide(const Point_3& s, const Point_3& t, const Point_3& a, const Point_3& b, const Point_3& c) const {
    return ask({s, t, a, b, c}).hits;
  }

private:
  Arithmetic arithmetic_;

  Sweep_answer ask(const std::array<Point_3, 5>& points) const {
    constexpr auto kind = static_cast<test::Sweep_kind>(feature);
    test::Sweep_coordinates x;
    for (int i = 0; i < 15; ++i)
      x[static_cast<std::size_t>(i)] = points[static_cast<std::size_t>(i / 3)][i % 3];
    switch (arithmetic_) {
    case Arithmetic::doubles:
      return determinant_sweep<double>(kind, x);
    case Arithmetic::long_doubles:
      return determinant_sweep<long double>(kind, x);
    default:
      return Paper_sweep(kind, x)();
    }
  }
};

struct Compare_rounded_time_3 {
  template <class Impact>
  CGAL::Comparison_result operator()(const Impact& a, const Impact& b) const {
    return CGAL::compare(a.time().first, b.time().first);
  }
};

/// A model of SweptCollisionTraits_3 that decides in the rounded arithmetic it is made with, and goes wrong now and
/// then. \pre that is not Arithmetic::exact
template <class K>
class Rounded_sweep_traits_3 {
public:
  using Point_3 = typename K::Point_3;
  using Impact_3 = Rounded_impact_3<K>;
  using Vertex_face_sweep_3 = Rounded_sweep_3<Impact_feature::vertex_face, K>;
  using Edge_edge_sweep_3 = Rounded_sweep_3<Impact_feature::edge_edge, K>;
  using Face_vertex_sweep_3 = Rounded_sweep_3<Impact_feature::face_vertex, K>;
  using Compare_time_3 = Compare_rounded_time_3;

  explicit Rounded_sweep_traits_3(Arithmetic arithmetic = Arithmetic::doubles) : arithmetic_(arithmetic) {}

  Vertex_face_sweep_3 vertex_face_sweep_3_object() const { return Vertex_face_sweep_3(arithmetic_); }
  Edge_edge_sweep_3 edge_edge_sweep_3_object() const { return Edge_edge_sweep_3(arithmetic_); }
  Face_vertex_sweep_3 face_vertex_sweep_3_object() const { return Face_vertex_sweep_3(arithmetic_); }
  Compare_time_3 compare_time_3_object() const { return {}; }

private:
  Arithmetic arithmetic_;
};

} // namespace haptic_sculpt::benchmark
