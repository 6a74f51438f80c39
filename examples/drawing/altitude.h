// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Dense>

#include <gmpxx.h>

#include <array>
#include <cmath>

namespace haptic_sculpt::drawing {

/// The altitude of c over ab, from rationals, rounded a few times. \pre a is not b
inline double exact_altitude(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  std::array<mpq_class, 3> u, v;
  for (int i = 0; i < 3; ++i)
    u[i] = mpq_class(b[i]) - mpq_class(a[i]), v[i] = mpq_class(c[i]) - mpq_class(a[i]);
  const auto squared = [](const mpq_class& x, const mpq_class& y, const mpq_class& z) {
    return mpq_class(x * x + y * y + z * z);
  };
  mpq_class square = squared(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) /
                     squared(u[0], u[1], u[2]);
  // In a unit in which no square leaves the range of doubles.
  const auto bits = [](const mpz_class& n) { return static_cast<long>(mpz_sizeinbase(n.get_mpz_t(), 2)); };
  const long half = (bits(square.get_num()) - bits(square.get_den())) / 2;
  if (half > 0)
    mpq_div_2exp(square.get_mpq_t(), square.get_mpq_t(), static_cast<mp_bitcnt_t>(2 * half));
  else
    mpq_mul_2exp(square.get_mpq_t(), square.get_mpq_t(), static_cast<mp_bitcnt_t>(-2 * half));
  return std::ldexp(std::sqrt(square.get_d()), static_cast<int>(half));
}

/// The altitude of c over ab, 0 where these are one point: to a millionth, or to 2^-1074, however thin the triangle is.
inline double altitude(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  constexpr double least_rounded = 0x1p-20; // of a side: what is less has lost too many bits
  constexpr double least_side = 0x1p-1000;  // shorter ones may have, too, being subnormal
  const double base = (b - a).stableNorm(), side = (c - a).stableNorm();
  if (!(base > 0))
    return 0;
  const double height = side * (b - a).stableNormalized().cross((c - a).stableNormalized()).norm();
  const bool is_exact = base < least_side || side < least_side || height < least_rounded * side;
  return is_exact ? exact_altitude(a, b, c) : height;
}

} // namespace haptic_sculpt::drawing
