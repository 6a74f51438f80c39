// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/exact_integers.h>

#include <cmath>

namespace haptic_sculpt::internal {

/// A double with an exponent that cannot overflow: exact integers of any size rounded to 53 bits or a few less.
///
/// Lengths and ratios of exact determinants are formed in it; slivers leave nothing of them in plain doubles.
struct Wide_double {
  double mantissa = 0; ///< 0, or of magnitude in [1/2, 1)
  long exponent = 0;

  Wide_double() = default;
  Wide_double(double value, long power) {
    int shift = 0;
    mantissa = std::frexp(value, &shift);
    exponent = mantissa == 0 ? 0 : power + shift;
  }
  explicit Wide_double(const Big_integer& x) {
    mantissa = mpz_get_d_2exp(&exponent, x.backend().data());
    if (mantissa == 0)
      exponent = 0;
  }
  template <std::size_t limbs>
  explicit Wide_double(Fixed_integer<limbs> x) {
    const bool negative = x.is_negative();
    if (negative)
      x = Fixed_integer<limbs>() - x;
    double magnitude = 0; // at most 2^768: far from overflow
    for (std::size_t i = limbs; i-- > 0;)
      magnitude = std::fma(magnitude, 0x1p64, static_cast<double>(x.limb[i]));
    *this = Wide_double(negative ? -magnitude : magnitude, 0);
  }

  /// Rounds, overflows and underflows as ldexp does.
  double to_double() const {
    return std::ldexp(mantissa, exponent > 4000 ? 4000 : exponent < -4000 ? -4000 : static_cast<int>(exponent));
  }

  friend Wide_double operator*(const Wide_double& a, const Wide_double& b) {
    return Wide_double(a.mantissa * b.mantissa, a.exponent + b.exponent);
  }
  /// \pre b is not 0
  friend Wide_double operator/(const Wide_double& a, const Wide_double& b) {
    return Wide_double(a.mantissa / b.mantissa, a.exponent - b.exponent);
  }
};

using Wide_vector = std::array<Wide_double, 3>;

/// The largest exponent among the coordinates that are not 0.
inline long common_exponent(const Wide_vector& v) {
  bool found = false;
  long exponent = 0;
  for (const Wide_double& x : v)
    if (x.mantissa != 0 && (!found || x.exponent > exponent)) {
      exponent = x.exponent;
      found = true;
    }
  return exponent;
}

/// The vector divided by 2^exponent, in doubles.
inline std::array<double, 3> mantissas(const Wide_vector& v, long exponent) {
  std::array<double, 3> result;
  for (int i = 0; i < 3; ++i)
    result[i] = Wide_double(v[i].mantissa, v[i].exponent - exponent).to_double();
  return result;
}

inline Wide_double length(const Wide_vector& v) {
  const long exponent = common_exponent(v);
  const std::array<double, 3> m = mantissas(v, exponent);
  return Wide_double(std::sqrt(std::fma(m[0], m[0], std::fma(m[1], m[1], m[2] * m[2]))), exponent);
}

} // namespace haptic_sculpt::internal
