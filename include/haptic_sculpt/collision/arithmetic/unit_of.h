// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace haptic_sculpt::internal {

/// The power of two that brings a length to about 1, where products of lengths stay in the range of doubles; it and its
/// inverse are normal numbers. 1 for 0, and for what is not finite.
inline double unit_of(double length) {
  if (!(length > 0) || !std::isfinite(length))
    return 1;
  return std::ldexp(1.0, std::max(-1000, std::min(1000, -std::ilogb(length))));
}

} // namespace haptic_sculpt::internal
