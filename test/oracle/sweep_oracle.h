// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oracle/Feasible_polytope.h"
#include "oracle/Sweep_kind.h"
#include "oracle/integer_coordinates.h"

#include <algorithm>
#include <gmpxx.h>
#include <optional>

namespace haptic_sculpt::test {

/// Whether the bounding boxes of the two closed hulls have no common point. Comparisons of doubles are exact.
inline bool boxes_are_disjoint(Sweep_kind kind, const Sweep_coordinates& x) {
  const int swept = swept_points(kind);
  for (int axis = 0; axis < 3; ++axis) {
    double low[2], high[2];
    for (int hull = 0; hull < 2; ++hull) {
      const int first = hull == 0 ? 0 : swept, last = hull == 0 ? swept : 5;
      low[hull] = high[hull] = x[3 * first + axis];
      for (int i = first + 1; i < last; ++i) {
        low[hull] = std::min(low[hull], x[3 * i + axis]);
        high[hull] = std::max(high[hull], x[3 * i + axis]);
      }
    }
    if (high[0] < low[1] || high[1] < low[0])
      return true;
  }
  return false;
}

enum class Early_out { none, boxes };

/// Visits the vertices of the polytope of weights with which the two closed hulls meet; none if they do not.
///
/// The hulls meet iff there are weights x >= 0, one for each of the five points, with
///     sum over swept points of x_i P_i = sum over standing points of x_j P_j,   both groups of weights summing to one.
/// Each coordinate axis is scaled by its own power of two, which changes no weight.
/// `visit` is called as in Feasible_polytope::visit_vertices().
/// \pre the coordinates are finite
template <class Visitor> void visit_meeting_weights(Sweep_kind kind, const Sweep_coordinates& x, Visitor&& visit) {
  const int swept = swept_points(kind);
  thread_local Feasible_polytope polytope; // keeps the memory of its numbers between queries
  for (int hull = 0; hull < 2; ++hull) { // the rows of ones first: their pivots keep the numbers small
    for (int i = 0; i < 5; ++i)
      polytope.row(hull)[i] = (i < swept) == (hull == 0) ? 1 : 0;
    polytope.row(hull)[Feasible_polytope::right_hand_side] = 1;
  }
  for (int axis = 0; axis < 3; ++axis) {
    Feasible_polytope::Row& row = polytope.row(2 + axis);
    scale_to_integers({x[axis], x[3 + axis], x[6 + axis], x[9 + axis], x[12 + axis]},
                      {row[0].get_mpz_t(), row[1].get_mpz_t(), row[2].get_mpz_t(), row[3].get_mpz_t(),
                       row[4].get_mpz_t()});
    for (int i = swept; i < 5; ++i)
      mpz_neg(row[i].get_mpz_t(), row[i].get_mpz_t());
    row[Feasible_polytope::right_hand_side] = 0;
  }
  polytope.visit_vertices(visit);
}

/// When the features first meet, and the weights of one of their common points then.
struct First_meeting {
  mpq_class time;                 ///< in [0, 1], in lowest terms
  std::array<bool, 5> has_weight; ///< which of the five points have a positive weight
};

/// The first u in [0, 1] at which the moving feature meets the other one, or nothing if it never does.
/// Shares neither a predicate nor a line with what it checks: it is linear feasibility over the integers.
///
/// A point of the swept hull with weights a of S and b of T, a + b > 0, lies on the moving feature when the vertex is
/// at (aS + bT)/(a + b), that is, at u = b/(a + b). With a + b = 0 it lies on the part that stands still, where the
/// feature is at every u, 0 included.
///
/// So u is to be minimised over the bounded polytope of weights, and looking at its vertices is enough:
/// - If a + b = 0 somewhere, those points are the face on which the linear form a + b attains its minimum, and a face
/// of
///   a bounded polytope has a vertex; that vertex says u = 0.
/// - Else a + b > 0 throughout, and u is continuous. For any t, { u <= t } = { b - t (a + b) <= 0 } is a half-space.
/// Let
///   t be the minimum: b - t (a + b) is then >= 0 on the polytope and vanishes somewhere, so it vanishes at a vertex.
/// S = T needs nothing of its own: the two columns are equal, and the basic solutions try each of them alone.
///
/// For a vertex and a face the first common point is unique, and so are its weights of A, B and C: `has_weight` then
/// says on which face, edge or vertex of the triangle it lies. \pre the coordinates are finite
inline std::optional<First_meeting> first_meeting(Sweep_kind kind, const Sweep_coordinates& x,
                                                  Early_out early_out = Early_out::boxes) {
  if (early_out == Early_out::boxes && boxes_are_disjoint(kind, x))
    return std::nullopt;
  std::optional<First_meeting> first;
  visit_meeting_weights(kind, x, [&first](const std::array<mpz_class, 5>& weight, const mpz_class&) {
    const mpz_class &start = weight[0], &end = weight[1];
    mpq_class u = 0;
    if (sgn(end) != 0) {
      u.get_num() = end;
      u.get_den() = start + end;
      u.canonicalize();
    }
    if (first && u >= first->time)
      return;
    first.emplace();
    first->time = u;
    for (int i = 0; i < 5; ++i)
      first->has_weight[i] = sgn(weight[i]) > 0;
  });
  return first;
}

/// The time of first_meeting() alone.
inline std::optional<mpq_class> first_time(Sweep_kind kind, const Sweep_coordinates& x,
                                           Early_out early_out = Early_out::boxes) {
  const std::optional<First_meeting> first = first_meeting(kind, x, early_out);
  return first ? std::optional<mpq_class>(first->time) : std::nullopt;
}

} // namespace haptic_sculpt::test
