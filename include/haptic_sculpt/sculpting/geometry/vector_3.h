// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// The little vector arithmetic behind stops and slides. Nothing here decides about geometry: it only proposes points.
///
/// Every product-sum of what follows, up to the quick ones, is an explicit fused multiply-add, so that compilers cannot
/// choose: the same drags give the same bits in every build.

#include <haptic_sculpt/collision/arithmetic/unit_of.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace haptic_sculpt::internal {

using Vector = std::array<double, 3>;

inline Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector plus(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vector scaled(const Vector& a, double factor) { return {a[0] * factor, a[1] * factor, a[2] * factor}; }

/// a + factor * b, each coordinate rounded once.
inline Vector advanced(const Vector& a, double factor, const Vector& b) {
  return {std::fma(factor, b[0], a[0]), std::fma(factor, b[1], a[1]), std::fma(factor, b[2], a[2])};
}

/// s * a + t * b
inline Vector combined(double s, const Vector& a, double t, const Vector& b) {
  return advanced(scaled(b, t), s, a);
}

inline double dot(const Vector& a, const Vector& b) {
  return std::fma(a[0], b[0], std::fma(a[1], b[1], a[2] * b[2]));
}

inline Vector cross(const Vector& a, const Vector& b) {
  return {std::fma(a[1], b[2], -(a[2] * b[1])), std::fma(a[2], b[0], -(a[0] * b[2])),
          std::fma(a[0], b[1], -(a[1] * b[0]))};
}

inline double largest_magnitude(const Vector& a) {
  return std::max(std::abs(a[0]), std::max(std::abs(a[1]), std::abs(a[2])));
}

/// Whether squares of a vector with this largest coordinate, and what is added to them, are far from both ends of the
/// range. Scaling by a power of two would change no bit of a length then, and costs more than the rest.
inline bool has_plain_squares(double largest) { return largest > 0x1p-400 && largest < 0x1p400; }

/// Euclidean length without overflow or underflow on the way: scaled by a power of two where that is needed.
inline double length(const Vector& a) {
  const double largest = largest_magnitude(a);
  if (has_plain_squares(largest))
    return std::sqrt(dot(a, a));
  if (largest == 0 || !std::isfinite(largest))
    return largest;
  const int exponent = std::ilogb(largest);
  const Vector b = {std::ldexp(a[0], -exponent), std::ldexp(a[1], -exponent), std::ldexp(a[2], -exponent)};
  return std::ldexp(std::sqrt(dot(b, b)), exponent);
}

/// The vector of length 1 in the direction of a; zero for zero.
inline Vector normalized(const Vector& a) {
  const double largest = largest_magnitude(a);
  if (has_plain_squares(largest)) {
    const double l = std::sqrt(dot(a, a));
    return {a[0] / l, a[1] / l, a[2] / l};
  }
  if (largest == 0 || !std::isfinite(largest))
    return {0, 0, 0};
  const int exponent = std::ilogb(largest);
  const Vector b = {std::ldexp(a[0], -exponent), std::ldexp(a[1], -exponent), std::ldexp(a[2], -exponent)};
  const double l = std::sqrt(dot(b, b));
  return {b[0] / l, b[1] / l, b[2] / l};
}

/// By how much `to` is nearer to `target` than `from` is; negative where it is farther. Keeps its digits where the
/// target is so far that both distances are the same double. Rounded.
inline double nearer_by(const Vector& target, const Vector& from, const Vector& to) {
  const Vector a = minus(target, from), b = minus(target, to);
  const double sum = length(a) + length(b);
  return sum > 0 ? dot(minus(to, from), {(a[0] + b[0]) / sum, (a[1] + b[1]) / sum, (a[2] + b[2]) / sum}) : 0;
}

/// \name Quick ones
/// For bounds, choices and proposals in the inner loops. Sums of products are rounded as they come, for std::fma() and
/// std::fmax() are calls where the processor at hand is not asked for.
///@{
inline double quick_dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector quick_cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double quick_squared_distance(const Vector& a, const Vector& b) {
  const Vector d = minus(a, b);
  return quick_dot(d, d);
}
/// a + factor * b
inline Vector quick_sum(const Vector& a, double factor, const Vector& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
inline double larger(double a, double b) {
  return a > b ? a : b;
}
inline double smaller(double a, double b) {
  return a < b ? a : b;
}
inline double quick_magnitude(const Vector& a) {
  return larger(std::abs(a[0]), larger(std::abs(a[1]), std::abs(a[2])));
}

/// Largest coordinate 1; zero for what is so small that its reciprocal is not a number.
inline Vector of_size_one(const Vector& a) {
  constexpr double least_size = 0x1p-1000;
  const double size = quick_magnitude(a);
  return size > least_size ? scaled(a, 1 / size) : Vector{};
}
///@}

} // namespace haptic_sculpt::internal
