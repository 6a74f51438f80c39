// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oracle/Sweep_kind.h"

#include <array>
#include <cstddef>
#include <gmpxx.h>
#include <vector>

namespace haptic_sculpt::test {

/// Coefficients c[0..n) of the variables and, last, a constant.
using Linear_form = std::vector<mpq_class>;
using Rational_point = std::array<mpq_class, 3>;

/// Whether some x makes every `equation` zero and every `inequality` non-negative. Equations are solved for one
/// variable and substituted; inequalities are eliminated variable by variable, each lower bound against each upper
/// (Fourier and Motzkin). Slow, and as plain as it can be: it checks the oracle.
inline bool is_feasible(std::vector<Linear_form> equations, std::vector<Linear_form> inequalities,
                        std::size_t variables) {
  const auto subtract_multiple = [](Linear_form& form, const Linear_form& other, const mpq_class& factor) {
    for (std::size_t i = 0; i < form.size(); ++i)
      form[i] -= factor * other[i];
  };
  while (!equations.empty()) {
    const Linear_form equation = equations.back();
    equations.pop_back();
    std::size_t v = 0;
    while (v < variables && equation[v] == 0)
      ++v;
    if (v == variables) {
      if (equation[variables] != 0)
        return false;
      continue;
    }
    for (auto* group : {&equations, &inequalities})
      for (Linear_form& form : *group)
        subtract_multiple(form, equation, form[v] / equation[v]);
  }
  for (std::size_t v = 0; v < variables; ++v) {
    std::vector<Linear_form> rest;
    for (const Linear_form& lower : inequalities) {
      if (lower[v] == 0)
        rest.push_back(lower);
      if (lower[v] <= 0)
        continue;
      for (const Linear_form& upper : inequalities)
        if (upper[v] < 0) {
          Linear_form sum = lower;
          subtract_multiple(sum, upper, lower[v] / upper[v]); // the factor is negative: a sum of non-negative forms
          rest.push_back(sum);
        }
    }
    inequalities = std::move(rest);
  }
  for (const Linear_form& constant : inequalities)
    if (constant[variables] < 0)
      return false;
  return true;
}

/// Whether the closed convex hulls of two non-empty point sets have a common point.
inline bool hulls_meet(const std::vector<Rational_point>& p, const std::vector<Rational_point>& q) {
  const std::size_t n = p.size() + q.size();
  std::vector<Linear_form> equations(5, Linear_form(n + 1)), inequalities(n, Linear_form(n + 1));
  for (std::size_t i = 0; i < n; ++i) {
    const bool first = i < p.size();
    for (std::size_t axis = 0; axis < 3; ++axis)
      equations[axis][i] = first ? p[i][axis] : mpq_class(-q[i - p.size()][axis]);
    equations[first ? 3 : 4][i] = 1;
    inequalities[i][i] = 1;
  }
  equations[3][n] = equations[4][n] = -1;
  return is_feasible(equations, inequalities, n);
}

inline Rational_point rational_point(const Sweep_coordinates& x, int i) {
  return {mpq_class(x[3 * i]), mpq_class(x[3 * i + 1]), mpq_class(x[3 * i + 2])};
}

/// Whether the swept hull meets the standing one: the second opinion on the verdict.
inline bool swept_hulls_meet(Sweep_kind kind, const Sweep_coordinates& x) {
  std::vector<Rational_point> p, q;
  for (int i = 0; i < 5; ++i)
    (i < swept_points(kind) ? p : q).push_back(rational_point(x, i));
  return hulls_meet(p, q);
}

/// Whether the feature touches the other one when the moving vertex is at S + u (T - S): sweeps by their definition,
/// one instant at a time. The instants at which it does are an interval, the image of a polytope under b/(a + b).
inline bool features_meet_at(Sweep_kind kind, const Sweep_coordinates& x, const mpq_class& u) {
  const Rational_point start = rational_point(x, 0), end = rational_point(x, 1);
  Rational_point moving;
  for (std::size_t axis = 0; axis < 3; ++axis)
    moving[axis] = start[axis] + u * (end[axis] - start[axis]);
  std::vector<Rational_point> p{moving}, q;
  for (int i = 2; i < 5; ++i)
    (i < swept_points(kind) ? p : q).push_back(rational_point(x, i));
  return hulls_meet(p, q);
}

} // namespace haptic_sculpt::test
