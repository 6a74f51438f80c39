// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cfenv>
#include <utility>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace haptic_sculpt::test {

/// As long as it lives, doubles are rounded so, and subnormal numbers are zeros or not, as a caller's program may have
/// it.
class Callers_mode {
public:
  Callers_mode(int rounding, bool flushes) {
    std::fesetround(rounding);
#if defined(__SSE2__)
    if (flushes)
      _mm_setcsr(_mm_getcsr() | 0x8040);
#else
    (void)flushes;
#endif
    at_first_ = control();
  }
  ~Callers_mode() {
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() & ~0x8040u);
#endif
    std::fesetround(FE_TONEAREST);
  }

  /// Whether all is as it was: the bits for what is rounded how, and what is flushed, not those that tell what has
  /// happened.
  bool stands() const { return control() == at_first_; }

private:
  std::pair<int, unsigned> at_first_;

  static std::pair<int, unsigned> control() {
#if defined(__SSE2__)
    return {std::fegetround(), _mm_getcsr() & ~0x3fu};
#else
    return {std::fegetround(), 0};
#endif
  }
};

} // namespace haptic_sculpt::test
