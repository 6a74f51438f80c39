// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace haptic_sculpt::internal {

/// The float next to x, as the processor rounds; to be used where that is compared with x, or becomes a double again.
///
/// g++ 12 at -O2 takes two conversions to float and back, of neighbours in memory, for none: the double stays as it was
/// (test_to_float.cpp). It does not see through this.
inline float to_float(double x) {
  float f = static_cast<float>(x);
#if defined(__GNUC__) && !defined(__clang__)
#if defined(__SSE2__)
  asm("" : "+x"(f));
#else
  asm("" : "+m"(f));
#endif
#endif
  return f;
}

} // namespace haptic_sculpt::internal
