// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// The delta rule along a drag (the 1997 paper, 3.1): when does a moving triangle first get an altitude below delta?
///
/// With J(u) = S + u (T - S) the doubled area vector n(u) = (G - J) x (I - J) is affine in u, so over each side of
/// length L the condition "altitude >= delta" is q(u) = |n|^2 - delta^2 L^2 >= 0 with q quadratic. The limit is inf { u
/// : q < 0 }: 0, a rational, or a root of a quadratic with rational coefficients. An altitude that is below delta at
/// the start may not get lower than it is there: then q(u) = |n(u)|^2 L(0)^2 - |n(0)|^2 L(u)^2. See doc/proofs/stop.md,
/// "The delta rule".

#include <haptic_sculpt/collision/Impact_3.h>
#include <haptic_sculpt/sculpting/geometry/vector_3.h>

#include <CGAL/Gmpq.h>
#include <CGAL/Root_of_traits.h>

#include <optional>

namespace haptic_sculpt::internal {

/// Which side of the moving triangle J, G, I an altitude stands on.
enum class Altitude_over : std::uint8_t { gi, ji, jg };

/// The squared side that an altitude stands on.
template <class Number>
Number squared_side(const std::array<Number, 3>& j, const std::array<Number, 3>& g, const std::array<Number, 3>& i,
                    Altitude_over side) {
  const std::array<Number, 3>& from = side == Altitude_over::gi ? g : j;
  const std::array<Number, 3>& to = side == Altitude_over::jg ? g : i;
  Number sum = 0;
  for (int k = 0; k < 3; ++k)
    sum += (to[k] - from[k]) * (to[k] - from[k]);
  return sum;
}

/// A quadratic q(u) = a u^2 + b u + c.
template <class Number>
struct Quadratic {
  Number a, b, c;
  Number at(const Number& u) const { return (a * u + b) * u + c; }
};

/// The square of an altitude of the moving triangle: |n|^2 over L^2.
template <class Number>
struct Squared_altitude {
  Quadratic<Number> area, side;

  /// area / side - level / unit, times side and unit.
  Quadratic<Number> over(const Number& level, const Number& unit) const {
    return {area.a * unit - level * side.a, area.b * unit - level * side.b, area.c * unit - level * side.c};
  }
};

/// That of one triangle over one of its sides.
template <class Number>
Squared_altitude<Number> squared_altitude(const std::array<Number, 3>& s, const std::array<Number, 3>& t,
                                          const std::array<Number, 3>& g, const std::array<Number, 3>& i,
                                          Altitude_over side) {
  const auto area = [&](const std::array<Number, 3>& j) {
    std::array<Number, 3> n;
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      n[k] = (g[l] - j[l]) * (i[m] - j[m]) - (g[m] - j[m]) * (i[l] - j[l]);
    }
    return n;
  };
  const std::array<Number, 3> n0 = area(s), n1 = area(t);
  Number start = 0, slope = 0, curvature = 0; // |n0 + u (n1 - n0)|^2
  for (int k = 0; k < 3; ++k) {
    const Number d = n1[k] - n0[k];
    start += n0[k] * n0[k];
    slope += 2 * n0[k] * d;
    curvature += d * d;
  }
  // The squared side is quadratic in u too; it follows from its values at 0 and 1 and its leading coefficient |T -
  // S|^2.
  const Number side0 = squared_side(s, g, i, side), side1 = squared_side(t, g, i, side);
  Number leading = 0;
  if (side != Altitude_over::gi)
    for (int k = 0; k < 3; ++k)
      leading += (t[k] - s[k]) * (t[k] - s[k]);
  return {{curvature, slope, start}, {leading, side1 - side0 - leading, side0}};
}

using Limit_time = CGAL::Root_of_traits<CGAL::Gmpq>::Root_of_2;

/// q times a power of two, which has the same roots: its largest coefficient is about 1, so that roots can be rounded.
inline Quadratic<CGAL::Gmpq> scaled_to_one(const Quadratic<CGAL::Gmpq>& q) {
  const auto exponent = [](const CGAL::Gmpq& x) { // of 2, within one; the least for 0
    return CGAL::is_zero(x) ? std::numeric_limits<long>::min()
                            : static_cast<long>(mpz_sizeinbase(mpq_numref(x.mpq()), 2)) -
                                  static_cast<long>(mpz_sizeinbase(mpq_denref(x.mpq()), 2));
  };
  const long largest = std::max({exponent(q.a), exponent(q.b), exponent(q.c)});
  if (largest == std::numeric_limits<long>::min())
    return q;
  const auto scaled = [largest](const CGAL::Gmpq& x) {
    CGAL::Gmpq y;
    if (largest > 0)
      mpq_div_2exp(y.mpq(), x.mpq(), static_cast<mp_bitcnt_t>(largest));
    else
      mpq_mul_2exp(y.mpq(), x.mpq(), static_cast<mp_bitcnt_t>(-largest));
    return y;
  };
  return {scaled(q.a), scaled(q.b), scaled(q.c)};
}

/// inf { u in [0, 1) : q(u) < 0 }, exact, or nothing. A q that only touches 0 is no violation.
inline std::optional<Limit_time> first_negative(const Quadratic<CGAL::Gmpq>& q) {
  using CGAL::sign;
  const CGAL::Sign a = sign(q.a), b = sign(q.b), c = sign(q.c);
  if (c == CGAL::NEGATIVE || (c == CGAL::ZERO && (b == CGAL::NEGATIVE || (b == CGAL::ZERO && a == CGAL::NEGATIVE))))
    return Limit_time(0);
  if (a == CGAL::ZERO) {
    if (b != CGAL::NEGATIVE || sign(q.b + q.c) != CGAL::NEGATIVE)
      return std::nullopt;
    return Limit_time(CGAL::Gmpq(-q.c / q.b));
  }
  if (a == CGAL::NEGATIVE) { // one root is not positive: q turns negative at the other
    if (sign(q.a + q.b + q.c) != CGAL::NEGATIVE)
      return std::nullopt;
    return CGAL::make_root_of_2(q.a, q.b, q.c, false);
  }
  if (b != CGAL::NEGATIVE || sign(q.b * q.b - 4 * q.a * q.c) != CGAL::POSITIVE)
    return std::nullopt;
  const Limit_time root = CGAL::make_root_of_2(q.a, q.b, q.c, true);
  if (CGAL::compare(root, CGAL::Gmpq(1)) == CGAL::SMALLER)
    return root;
  return std::nullopt;
}

inline std::array<CGAL::Gmpq, 3> exact(const Coordinates& p) {
  return {CGAL::Gmpq(p[0]), CGAL::Gmpq(p[1]), CGAL::Gmpq(p[2])};
}

/// Bernstein coefficients of q in doubles exceed the rounding error: certainly no violation. With E
/// the largest difference from S, roundings are at most 5,900 units of 2^-52 of E^4 and 310 of E^2 delta^2, added up in
/// the worst case; 2^-38 is 16,384.
inline bool certainly_high(Coordinates s, Coordinates t, Coordinates g, Coordinates i, double delta,
                           Altitude_over side) {
  double extent = 0;
  for (int k = 0; k < 3; ++k)
    for (const Coordinates* p : {&t, &g, &i})
      extent = std::fmax(extent, std::abs((*p)[k] - s[k]));
  if (!(extent > 0x1p-100 && extent < 0x1p+100)) { // in a unit of its own, or else products might leave the range
    const double unit = unit_of(extent);
    for (Coordinates* p : {&s, &t, &g, &i})
      *p = scaled(*p, unit);
    extent *= unit, delta *= unit;
  }
  const Quadratic<double> q = squared_altitude<double>(s, t, g, i, side).over(delta * delta, 1);
  const double square = extent * extent;
  const double error = 0x1p-38 * square * (square + delta * delta);
  const double lowest = std::fmin(q.c, std::fmin(q.c + q.b / 2, q.a + q.b + q.c));
  return extent > 0x1p-200 && extent < 0x1p+200 && delta > 0x1p-200 && delta < 0x1p+200 && lowest > error;
}

/// When the triangle J, G, I first gets the altitude over `side` below delta, or below what it is at the start where
/// that is less; exactly, or nothing.
inline std::optional<Limit_time> delta_limit(const Coordinates& s, const Coordinates& t, const Coordinates& g,
                                             const Coordinates& i, double delta, Altitude_over side) {
  if (certainly_high(s, t, g, i, delta, side))
    return std::nullopt;
  const auto h = squared_altitude<CGAL::Gmpq>(exact(s), exact(t), exact(g), exact(i), side);
  Quadratic<CGAL::Gmpq> q = h.over(CGAL::Gmpq(delta) * CGAL::Gmpq(delta), CGAL::Gmpq(1));
  if (CGAL::sign(q.c) == CGAL::NEGATIVE)
    q = h.over(h.area.c, h.side.c);
  return first_negative(scaled_to_one(q));
}

/// The gradient of the altitude where J is: how much it grows when J moves. Floating point.
inline Vector altitude_slope(const Coordinates& at, const Coordinates& far_g, const Coordinates& far_i,
                             Altitude_over side) {
  // Relative to J, and of size one: the gradient has no unit, and no product over- or underflows.
  const Vector to_g = minus(far_g, at), to_i = minus(far_i, at), j{};
  const double size = std::fmax(largest_magnitude(to_g), largest_magnitude(to_i));
  const Vector g = {to_g[0] / size, to_g[1] / size, to_g[2] / size},
               i = {to_i[0] / size, to_i[1] / size, to_i[2] / size};
  const Vector n = cross(g, i);
  const Vector area_gradient = cross(minus(g, i), normalized(n));
  if (side == Altitude_over::gi)
    return normalized(area_gradient);
  const Vector along = minus(j, side == Altitude_over::ji ? i : g);
  const double l = length(along);
  // grad (|n| / L) = grad |n| / L - |n| / L^2 grad L
  return scaled(advanced(area_gradient, -length(n) / (l * l), along), 1 / l);
}

/// The direction in which the altitude grows fastest when J moves, of length 1; floating point.
inline Vector altitude_gradient(const Coordinates& j, const Coordinates& g, const Coordinates& i, Altitude_over side) {
  return normalized(altitude_slope(j, g, i, side));
}

/// The altitude in doubles.
inline double altitude(const Coordinates& j, const Coordinates& g, const Coordinates& i, Altitude_over side) {
  const Vector base = side == Altitude_over::gi ? minus(g, i) : minus(j, side == Altitude_over::ji ? i : g);
  return length(cross(normalized(base), minus(side == Altitude_over::jg ? i : g, j)));
}

/// How far J is from where that altitude would be this length, to first order; negative where it is less already.
inline double distance_to_altitude(const Coordinates& j, const Coordinates& g, const Coordinates& i, Altitude_over side,
                                   double least) {
  const double slope = length(altitude_slope(j, g, i, side));
  return (altitude(j, g, i, side) - least) / (slope > 0 ? slope : 1);
}

} // namespace haptic_sculpt::internal
