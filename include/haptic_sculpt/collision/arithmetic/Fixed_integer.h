// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace haptic_sculpt::internal {

__extension__ typedef unsigned __int128 Double_limb;

/// A signed integer of `limbs` 64-bit limbs, two's complement, least significant limb first, on the stack.
///
/// The product of two has the limbs of both, so products never overflow. Sums and differences keep the width: whoever
/// adds must know that there is room (doc/proofs/sweep_arithmetic.md counts the bits).
template <std::size_t limbs>
struct Fixed_integer {
  std::array<std::uint64_t, limbs> limb{};

  bool is_negative() const { return static_cast<std::int64_t>(limb[limbs - 1]) < 0; }

  /// -1, 0 or 1.
  int sign() const {
    if (is_negative())
      return -1;
    std::uint64_t any = 0;
    for (std::uint64_t part : limb)
      any |= part;
    return any != 0;
  }

  Fixed_integer& operator+=(const Fixed_integer& other) {
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < limbs; ++i) {
      const Double_limb sum = static_cast<Double_limb>(limb[i]) + other.limb[i] + carry;
      limb[i] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64);
    }
    return *this;
  }

  Fixed_integer& operator-=(const Fixed_integer& other) {
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < limbs; ++i) {
      const Double_limb difference = static_cast<Double_limb>(limb[i]) - other.limb[i] - borrow;
      limb[i] = static_cast<std::uint64_t>(difference);
      borrow = static_cast<std::uint64_t>(difference >> 64) & 1U;
    }
    return *this;
  }

  friend Fixed_integer operator+(Fixed_integer a, const Fixed_integer& b) { return a += b; }
  friend Fixed_integer operator-(Fixed_integer a, const Fixed_integer& b) { return a -= b; }
};

/// The exact product.
template <std::size_t m, std::size_t n>
Fixed_integer<m + n> operator*(const Fixed_integer<m>& a, const Fixed_integer<n>& b) {
  Fixed_integer<m + n> product;
  for (std::size_t i = 0; i < m; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const Double_limb t = static_cast<Double_limb>(a.limb[i]) * b.limb[j] + product.limb[i + j] + carry;
      product.limb[i + j] = static_cast<std::uint64_t>(t);
      carry = static_cast<std::uint64_t>(t >> 64);
    }
    product.limb[i + n] = carry;
  }
  // The limbs were taken for unsigned: a negative factor counted 2^(64 limbs) too much.
  const auto take_from_top = [&product](const auto& factor, std::size_t from, std::uint64_t mask) {
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < factor.limb.size(); ++i) {
      const Double_limb t = static_cast<Double_limb>(product.limb[from + i]) - (factor.limb[i] & mask) - borrow;
      product.limb[from + i] = static_cast<std::uint64_t>(t);
      borrow = static_cast<std::uint64_t>(t >> 64) & 1U;
    }
  };
  take_from_top(b, m, a.is_negative() ? ~std::uint64_t{0} : 0);
  take_from_top(a, n, b.is_negative() ? ~std::uint64_t{0} : 0);
  return product;
}

/// The same value in more limbs.
template <std::size_t wide, std::size_t narrow>
Fixed_integer<wide> widened(const Fixed_integer<narrow>& a) {
  static_assert(wide >= narrow, "widened() does not narrow");
  Fixed_integer<wide> result;
  const std::uint64_t fill = a.is_negative() ? ~std::uint64_t{0} : 0;
  for (std::size_t i = 0; i < wide; ++i)
    result.limb[i] = i < narrow ? a.limb[i] : fill;
  return result;
}

} // namespace haptic_sculpt::internal
