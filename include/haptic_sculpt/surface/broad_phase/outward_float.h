// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Box_3.h>
#include <haptic_sculpt/to_float.h>

#include <cstdint>
#include <cstring>

namespace haptic_sculpt::internal {

/// The float next to x towards -infinity, if `is_wanted`, else x: compiled without a branch, for which
/// of both is wanted is as good as random.
/// \pre x is neither NaN nor -infinity
inline float next_down(float x, bool is_wanted = true) {
  std::int32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  if ((bits == 0) & is_wanted)
    bits = std::numeric_limits<std::int32_t>::min(); // the zero whose neighbour has the next bits
  bits += (bits < 0 ? 1 : -1) & -std::int32_t{is_wanted};
  std::memcpy(&x, &bits, sizeof bits);
  return x;
}

/// A float that is not above x. The conversion may round either way; a comparison, which does not round, tells.
inline float float_below(double x) {
  const float f = to_float(x);
  return next_down(f, static_cast<double>(f) > x);
}

/// A float that is not below x.
inline float float_above(double x) {
  return -float_below(-x);
}

/// A closed box of floats. Box_scale makes them.
struct Float_box {
  std::array<float, 3> lower, upper;

  /// The box that holds nothing. It meets no `query()` box, and grows.
  Float_box() {
    lower.fill(std::numeric_limits<float>::infinity());
    upper.fill(-std::numeric_limits<float>::infinity());
  }
};

} // namespace haptic_sculpt::internal
