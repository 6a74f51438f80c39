// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// The point nearest to a target among those that keep a clearance from some planes, in GMP rationals.
///
/// Shares nothing with the response: no facets, no regions, no sweeps, nothing of CGAL. The problem is convex, so its
/// optimum is unique, and it is distinguished from all other points by the conditions of Karush, Kuhn and Tucker.

#include <algorithm>
#include <array>
#include <cmath>
#include <gmpxx.h>
#include <optional>
#include <stdexcept>
#include <vector>

namespace haptic_sculpt::test {

using Rational_point = std::array<mpq_class, 3>;

inline Rational_point rational(const std::array<double, 3>& p) {
  return {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])};
}

inline mpq_class product(const Rational_point& a, const Rational_point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Rational_point difference(const Rational_point& a, const Rational_point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// A square root with a relative error below 2^-200, from below. \pre x >= 0
inline mpq_class square_root(const mpq_class& x) {
  // sqrt(p / q) = sqrt(p q) / q; the integer root of p q 4^k has k more bits.
  constexpr unsigned k = 256;
  const mpz_class scaled = x.get_num() * x.get_den();
  mpz_class root = sqrt(mpz_class(scaled << (2 * k)));
  mpq_class result(root, mpz_class(x.get_den() << k));
  result.canonicalize();
  return result;
}

inline double distance(const Rational_point& a, const Rational_point& b) {
  const Rational_point d = difference(a, b);
  return square_root(product(d, d)).get_d();
}

/// The side of the plane through three points on which orientation(plane[0], plane[1], plane[2], y) has the sign
/// `side`.
struct Half_space {
  std::array<std::array<double, 3>, 3> plane;
  int side;
};

/// { y : n_i . (y - a_i) >= clearance |n_i| for all i }, n_i the exact normal of half-space i, and nearest points in
/// it.
///
/// The offsets `clearance` |n_i| are square roots; they are rounded below by a part of 2^-200, everything else is
/// exact.
class Offset_half_spaces {
public:
  struct Optimum {
    Rational_point point;
    std::vector<std::size_t> active; ///< the half-spaces that push, each with a multiplier > 0; at most three
  };

  Offset_half_spaces(const std::vector<Half_space>& half_spaces, double clearance) {
    for (const Half_space& h : half_spaces) {
      const Rational_point a = rational(h.plane[0]), b = difference(rational(h.plane[1]), a),
                           c = difference(rational(h.plane[2]), a);
      Plane plane;
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        plane.normal[i] = h.side * (b[j] * c[k] - b[k] * c[j]);
      }
      const mpq_class length = square_root(product(plane.normal, plane.normal));
      if (length == 0)
        throw std::invalid_argument("Offset_half_spaces: three points of a plane are collinear");
      plane.least = product(plane.normal, a) + mpq_class(clearance) * length;
      for (int i = 0; i < 3; ++i)
        plane.unit[i] = mpq_class(plane.normal[i] / length).get_d();
      plane.unit_least = mpq_class(plane.least / length).get_d();
      planes_.push_back(plane);
    }
  }

  /// Of length 1, to the nearest doubles.
  const std::array<double, 3>& normal(std::size_t i) const { return planes_[i].unit; }

  /// Whether y keeps the clearance from all planes, exactly.
  bool contains(const Rational_point& y) const { return !most_violated(y).has_value(); }

  /// The unique point nearest to the target. Starts with no constraint, and adds the one that its optimum violates most
  /// and forgets those that do not push, until none is violated: the distance grows every time, so that ends.
  /// \throw std::logic_error where the intersection is empty
  Optimum nearest(const std::array<double, 3>& target) const {
    const Rational_point t = rational(target);
    Optimum best{t, {}};
    while (const auto next = most_violated(best.point)) {
      std::vector<std::size_t> working = best.active;
      working.push_back(*next);
      best = nearest_of(t, working);
    }
    return best;
  }

  /// The least singular value of the normals of the given planes: how well they determine a point. \pre 1 to 3,
  /// independent
  double least_singular_value(const std::vector<std::size_t>& active) const {
    // Columns of length 1, so the least eigenvalue of their Gram matrix is in [0, 1]: bisected by Sylvester's inertia.
    double low = 0, high = 1;
    for (int i = 0; i < 100; ++i) {
      const double middle = (low + high) / 2;
      (is_positive_definite(active, middle) ? low : high) = middle;
    }
    return std::sqrt(high);
  }

private:
  struct Plane {
    Rational_point normal; ///< of any length
    mpq_class least;       ///< normal . y >= least
    std::array<double, 3> unit;
    double unit_least;
  };
  std::vector<Plane> planes_;

  std::optional<std::size_t> most_violated(const Rational_point& y) const {
    std::optional<std::size_t> worst;
    double most = 0;
    const std::array<double, 3> rounded = {y[0].get_d(), y[1].get_d(), y[2].get_d()};
    const double size = 1 + std::abs(rounded[0]) + std::abs(rounded[1]) + std::abs(rounded[2]);
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      const Plane& plane = planes_[i];
      double excess = -plane.unit_least;
      for (int k = 0; k < 3; ++k)
        excess += plane.unit[k] * rounded[k];
      if (excess > 1e-10 * (size + std::abs(plane.unit_least))) // far beyond what doubles err
        continue;
      const mpq_class exact = product(plane.normal, y) - plane.least;
      if (sgn(exact) < 0 && (!worst || excess < most)) {
        worst = i;
        most = excess;
      }
    }
    return worst;
  }

  /// All sets of up to three constraints: equality on them, multipliers > 0, the others kept.
  Optimum nearest_of(const Rational_point& t, const std::vector<std::size_t>& among) const {
    const std::size_t n = among.size();
    for (unsigned subset = 0; subset < (1u << n); ++subset) {
      std::vector<std::size_t> active;
      for (std::size_t i = 0; i < n; ++i)
        if (subset >> i & 1u)
          active.push_back(among[i]);
      if (active.size() > 3)
        continue;
      const auto y = stationary(t, active);
      if (y && std::all_of(among.begin(), among.end(),
                           [&](std::size_t i) { return product(planes_[i].normal, *y) >= planes_[i].least; }))
        return {*y, active};
    }
    throw std::logic_error("Offset_half_spaces: no point keeps the clearance from all planes");
  }

  /// t + sum of multiplier_i normal_i on all planes of `active`, if all multipliers are positive.
  std::optional<Rational_point> stationary(const Rational_point& t, const std::vector<std::size_t>& active) const {
    const std::size_t n = active.size();
    std::vector<std::vector<mpq_class>> row(n, std::vector<mpq_class>(n + 1));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j)
        row[i][j] = product(planes_[active[i]].normal, planes_[active[j]].normal);
      row[i][n] = planes_[active[i]].least - product(planes_[active[i]].normal, t);
    }
    // A Gram matrix: its pivots on the diagonal are positive, or the normals are dependent and fewer of them will do.
    for (std::size_t p = 0; p < n; ++p) {
      if (sgn(row[p][p]) == 0)
        return std::nullopt;
      for (std::size_t i = 0; i < n; ++i) {
        if (i == p)
          continue;
        const mpq_class factor = row[i][p] / row[p][p];
        for (std::size_t j = p; j <= n; ++j)
          row[i][j] -= factor * row[p][j];
      }
    }
    Rational_point y = t;
    for (std::size_t i = 0; i < n; ++i) {
      const mpq_class multiplier = row[i][n] / row[i][i];
      if (sgn(multiplier) <= 0)
        return std::nullopt;
      for (int k = 0; k < 3; ++k)
        y[k] += multiplier * planes_[active[i]].normal[k];
    }
    return y;
  }

  bool is_positive_definite(const std::vector<std::size_t>& active, double shift) const {
    const std::size_t n = active.size();
    std::array<std::array<double, 3>, 3> m{};
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const auto &a = planes_[active[i]].unit, &b = planes_[active[j]].unit;
        m[i][j] = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] - (i == j ? shift : 0);
      }
    for (std::size_t p = 0; p < n; ++p) {
      if (!(m[p][p] > 0))
        return false;
      for (std::size_t i = p + 1; i < n; ++i)
        for (std::size_t j = n; j-- > p;)
          m[i][j] -= m[i][p] / m[p][p] * m[p][j];
    }
    return true;
  }
};

} // namespace haptic_sculpt::test
