// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oracle/fourier_motzkin.h"

#include <algorithm>

namespace haptic_sculpt::test {

/// Four points that move along one axis: what `AX` asks in a file of queries.
struct Axis_query {
  bool is_vertex_and_face; ///< else two edges
  int axis;
  std::array<std::array<double, 3>, 4> start; ///< V A B C, or the ends of two edges
  std::array<double, 4> end;                  ///< along the axis
};

/// Four points at a time, in rational numbers.
inline std::array<Rational_point, 4> points_at(const Axis_query& query, const mpq_class& t) {
  std::array<Rational_point, 4> points;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k)
      points[i][k] = query.start[i][k];
    mpq_class& height = points[i][query.axis];
    height += t * (mpq_class(query.end[i]) - height);
  }
  return points;
}

/// Every time in [0, 1] at which the order of two points, the side of a line or the side of a plane can change, with
/// both ends and a time between any two of these: all that can be distinguished happens at one of them.
///
/// Which of these functions are constant is not asked: each is affine in time, as one coordinate is, and its root
/// follows from its two end values.
inline std::vector<mpq_class> critical_times(const Axis_query& query) {
  const auto start = points_at(query, 0), end = points_at(query, 1);
  const auto minor = [](const std::array<Rational_point, 4>& p, int a, int b, int c, int i, int j) {
    return mpq_class((p[b][i] - p[a][i]) * (p[c][j] - p[a][j]) - (p[b][j] - p[a][j]) * (p[c][i] - p[a][i]));
  };
  const auto volume = [](const std::array<Rational_point, 4>& p) {
    mpq_class sum = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      sum += (p[1][i] - p[0][i]) *
             ((p[2][j] - p[0][j]) * (p[3][k] - p[0][k]) - (p[2][k] - p[0][k]) * (p[3][j] - p[0][j]));
    }
    return sum;
  };
  std::vector<mpq_class> times{0, 1};
  const auto add_root = [&times](const mpq_class& at_start, const mpq_class& at_end) {
    if (at_start != at_end) {
      const mpq_class t = at_start / (at_start - at_end);
      if (t > 0 && t < 1)
        times.push_back(t);
    }
  };
  add_root(volume(start), volume(end));
  for (int a = 0; a < 4; ++a)
    for (int b = a + 1; b < 4; ++b) {
      add_root(start[a][query.axis] - start[b][query.axis], end[a][query.axis] - end[b][query.axis]);
      for (int c = b + 1; c < 4; ++c)
        for (int i = 0; i < 3; ++i)
          add_root(minor(start, a, b, c, i, (i + 1) % 3), minor(end, a, b, c, i, (i + 1) % 3));
    }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  for (std::size_t i = times.size() - 1; i > 0; --i)
    times.push_back((times[i] + times[i - 1]) / 2);
  return times;
}

/// Whether the two closed features have a common point at a time: convex hulls, by linear feasibility.
inline bool axis_features_meet_at(const Axis_query& query, const mpq_class& t) {
  const auto points = points_at(query, t);
  const auto first_end = points.begin() + (query.is_vertex_and_face ? 1 : 2);
  return hulls_meet({points.begin(), first_end}, {first_end, points.end()});
}

/// Whether they meet at some time of the motion. Shares no predicate with what it checks.
inline bool axis_features_meet(const Axis_query& query) {
  for (const mpq_class& t : critical_times(query))
    if (axis_features_meet_at(query, t))
      return true;
  return false;
}

/// Whether points 1, 2 and 3 lie on one line at some time.
inline bool axis_face_degenerates(const Axis_query& query) {
  for (const mpq_class& t : critical_times(query)) {
    const auto p = points_at(query, t);
    bool on_line = true;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      on_line &= (p[2][i] - p[1][i]) * (p[3][j] - p[1][j]) == (p[2][j] - p[1][j]) * (p[3][i] - p[1][i]);
    }
    if (on_line)
      return true;
  }
  return false;
}

} // namespace haptic_sculpt::test
