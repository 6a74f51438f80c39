// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_ROUNDING_TO_NEAREST_H
#define HAPTIC_SCULPT_ROUNDING_TO_NEAREST_H

#include <cfenv>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace haptic_sculpt {
namespace internal {

/// As long as it lives, arithmetic of this thread rounds to nearest and keeps subnormal numbers; then it is as the
/// caller had it.
///
/// Decimals are read and written, and CGAL's static filters are proven, in this mode only. A program may have set
/// another one (interval arithmetic does), or have been linked with -ffast-math, which makes each thread flush
/// subnormal numbers to zero. Costs a few nanoseconds where nothing has to be changed.
class Rounding_to_nearest {
public:
  Rounding_to_nearest()
      : mode_(std::fegetround())
#if defined(__SSE2__)
      , sse_(_mm_getcsr())
#endif
  {
    changed_ = mode_ != FE_TONEAREST;
#if defined(__SSE2__)
    changed_ |= (sse_ & (rounding | flush_to_zero | subnormals_are_zero)) != 0;
#endif
    if (!changed_)
      return;
    std::fesetround(FE_TONEAREST); // the x87 unit, too, which the C library asks
#if defined(__SSE2__)
    _mm_setcsr(sse_ & ~(rounding | flush_to_zero | subnormals_are_zero));
#endif
  }

  ~Rounding_to_nearest() {
    if (!changed_)
      return;
    std::fesetround(mode_);
#if defined(__SSE2__)
    _mm_setcsr(sse_);
#endif
  }

  Rounding_to_nearest(const Rounding_to_nearest&) = delete;
  Rounding_to_nearest& operator=(const Rounding_to_nearest&) = delete;

private:
#if defined(__SSE2__)
  // Bits of the control register.
  static constexpr unsigned subnormals_are_zero = 0x0040, rounding = 0x6000, flush_to_zero = 0x8000;
#endif
  int mode_;
#if defined(__SSE2__)
  unsigned sse_;
#endif
  bool changed_;
};

} // namespace internal
} // namespace haptic_sculpt

#endif
