// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdint>
#include <gmp.h>

namespace haptic_sculpt::test {

/// Writes `value[i]` times one power of two, the same for all i, to the integers `result[i]`. No bit is lost.
/// \pre the values are finite
template <std::size_t N> void scale_to_integers(const double (&value)[N], mpz_ptr const (&result)[N]) {
  std::int64_t mantissa[N];
  int exponent[N];
  int least = INT_MAX;
  for (std::size_t i = 0; i < N; ++i) {
    mantissa[i] = static_cast<std::int64_t>(std::ldexp(std::frexp(value[i], &exponent[i]), 53));
    if (mantissa[i] != 0)
      least = std::min(least, exponent[i]);
  }
  for (std::size_t i = 0; i < N; ++i) {
    mpz_set_si(result[i], mantissa[i]);
    if (mantissa[i] != 0)
      mpz_mul_2exp(result[i], result[i], static_cast<mp_bitcnt_t>(exponent[i] - least));
  }
}

} // namespace haptic_sculpt::test
