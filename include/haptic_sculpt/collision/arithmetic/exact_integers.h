// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Doubles as integer multiples of one power of two: the exact stage behind the floating-point filters.
///
/// Signs of determinants do not change when all coordinates are divided by one power of two, so a handful of doubles
/// becomes a handful of integers. Doubles of like size need one 64-bit limb, doubles up to 2^71 apart two, up to 2^199
/// apart (0 and what rounding makes of it) four, and anything else GMP, which allocates. See
/// doc/proofs/sweep_arithmetic.md, "The integer stages".

#include <haptic_sculpt/collision/arithmetic/Fixed_integer.h>

#include <boost/multiprecision/gmp.hpp>

#include <array>
#include <cstdint>
#include <cstring>

namespace haptic_sculpt::internal {

using Coordinates = std::array<double, 3>;

/// GMP integers without expression templates, so that `auto` holds values.
using Big_integer = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;

/// A double taken apart: `x == mantissa * 2^exponent`, |mantissa| < 2^53.
struct Split_double {
  std::int64_t mantissa;
  int exponent;

  explicit Split_double(double x) {
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    const int biased = static_cast<int>((bits >> 52) & 0x7ffU);
    const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
    const std::int64_t magnitude =
        static_cast<std::int64_t>(biased == 0 ? fraction : fraction | (std::uint64_t{1} << 52));
    mantissa = (bits >> 63) != 0 ? -magnitude : magnitude;
    exponent = (biased == 0 ? 1 : biased) - 1075;
  }
};

/// The exponents met among some doubles; zeros have none.
struct Exponent_range {
  int lowest = 4096;
  int highest = -4096;

  void include(double x) {
    const Split_double split(x);
    if (split.mantissa == 0) // not x == 0, which a processor told to flush subnormals answers wrongly
      return;
    lowest = split.exponent < lowest ? split.exponent : lowest;
    highest = split.exponent > highest ? split.exponent : highest;
  }
  void include(const Coordinates& p) {
    for (double x : p)
      include(x);
  }
  int spread() const { return highest > lowest ? highest - lowest : 0; }
};

/// 53 + 8 = 61 bits a coordinate, 62 a difference: a 3x3 determinant of differences stays below 2^189 < 2^191.
constexpr int one_limb_spread = 8;
/// 53 + 71 = 124 bits a coordinate, 125 a difference: a 3x3 determinant stays below 2^378 < 2^383.
constexpr int two_limb_spread = 71;

/// 53 + 199 = 252 bits a coordinate, 253 a difference: a 3x3 determinant stays below 2^762 < 2^767.
constexpr int four_limb_spread = 199;

/// `x / 2^lowest` as an integer. \pre 0 <= exponent of x - lowest <= the spread that Integer has room for, or x = 0.
template <class Integer>
struct Integer_of_double;

template <>
struct Integer_of_double<Fixed_integer<1>> {
  static Fixed_integer<1> convert(double x, int lowest) {
    const Split_double split(x);
    return {{static_cast<std::uint64_t>(split.mantissa) << (split.mantissa == 0 ? 0 : split.exponent - lowest)}};
  }
};

template <>
struct Integer_of_double<Fixed_integer<2>> {
  static Fixed_integer<2> convert(double x, int lowest) {
    const Split_double split(x);
    if (split.mantissa == 0)
      return {};
    const Double_limb high = split.mantissa < 0 ? ~Double_limb{0} << 64 : 0;
    const Double_limb shifted = (high | static_cast<std::uint64_t>(split.mantissa)) << (split.exponent - lowest);
    return {{static_cast<std::uint64_t>(shifted), static_cast<std::uint64_t>(shifted >> 64)}};
  }
};

template <>
struct Integer_of_double<Fixed_integer<4>> {
  static Fixed_integer<4> convert(double x, int lowest) {
    const Split_double split(x);
    Fixed_integer<4> integer;
    if (split.mantissa == 0)
      return integer;
    const auto shift = static_cast<unsigned>(split.exponent - lowest);
    const Double_limb fill = split.mantissa < 0 ? ~Double_limb{0} : 0;
    const Double_limb shifted = ((fill << 64) | static_cast<std::uint64_t>(split.mantissa)) << (shift % 64);
    const std::size_t first = shift / 64;
    for (std::size_t i = first; i < 4; ++i)
      integer.limb[i] = static_cast<std::uint64_t>(i == first ? shifted : i == first + 1 ? shifted >> 64 : fill);
    return integer;
  }
};

template <>
struct Integer_of_double<Big_integer> {
  static Big_integer convert(double x, int lowest) {
    const Split_double split(x);
    Big_integer integer = split.mantissa;
    if (split.mantissa != 0)
      integer <<= split.exponent - lowest;
    return integer;
  }
};

template <class Integer>
std::array<Integer, 3> to_integers(const Coordinates& p, int lowest) {
  return {Integer_of_double<Integer>::convert(p[0], lowest), Integer_of_double<Integer>::convert(p[1], lowest),
          Integer_of_double<Integer>::convert(p[2], lowest)};
}

inline int sign_of(const Big_integer& x) { return x.sign(); }
template <std::size_t limbs>
int sign_of(const Fixed_integer<limbs>& x) {
  return x.sign();
}

/// Calls `function(Integer())` with the narrowest integer type that has room for determinants of the points.
template <class Function, class Counters>
auto with_exact_integers(const Exponent_range& range, Counters& counters, const Function& function) {
  if (range.spread() <= one_limb_spread) {
    counters.count_integer_64();
    return function(Fixed_integer<1>());
  }
  if (range.spread() <= two_limb_spread) {
    counters.count_integer_128();
    return function(Fixed_integer<2>());
  }
  if (range.spread() <= four_limb_spread) {
    counters.count_integer_256();
    return function(Fixed_integer<4>());
  }
  counters.count_big_integer();
  return function(Big_integer());
}

/// Determinant of (b - a, c - a, d - a).
template <class Integer>
auto orientation_determinant_3(const std::array<Integer, 3>& a, const std::array<Integer, 3>& b,
                               const std::array<Integer, 3>& c, const std::array<Integer, 3>& d) {
  const Integer bx = b[0] - a[0], by = b[1] - a[1], bz = b[2] - a[2];
  const Integer cx = c[0] - a[0], cy = c[1] - a[1], cz = c[2] - a[2];
  const Integer dx = d[0] - a[0], dy = d[1] - a[1], dz = d[2] - a[2];
  return (bx * cy - by * cx) * dz + (by * cz - bz * cy) * dx + (bz * cx - bx * cz) * dy;
}

/// Determinant of (b - a, c - a) in the plane that is left when coordinate `axis` is dropped.
template <class Integer>
auto orientation_determinant_2(const std::array<Integer, 3>& a, const std::array<Integer, 3>& b,
                               const std::array<Integer, 3>& c, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  return (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
}

} // namespace haptic_sculpt::internal
