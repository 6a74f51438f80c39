// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cfenv>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace haptic_sculpt::internal {

/// As long as it lives, arithmetic of this thread rounds to nearest and keeps subnormal numbers; then it is as the
/// caller had it.
///
/// Decimals are read and written, and CGAL's static filters are proven, in this mode only. A program may have set
/// another one (interval arithmetic does), or have been linked with -ffast-math, which makes each thread flush
/// subnormal numbers to zero. Costs a few nanoseconds where nothing has to be changed.
class Rounding_to_nearest {
public:
  Rounding_to_nearest() : was_(state()), changed_(!is_nearest(was_)) {
    if (changed_)
      set_nearest();
#if defined(__GNUC__)
    // That it is the same at the end the compiler is not to know: it would make what follows twice, and what both have
    // in common before the mode is asked for.
    asm volatile("" : "+r"(changed_));
#endif
  }
  ~Rounding_to_nearest() {
    if (changed_)
      set_back();
  }
  Rounding_to_nearest(const Rounding_to_nearest&) = delete;
  Rounding_to_nearest& operator=(const Rounding_to_nearest&) = delete;

private:
#if defined(__SSE2__)
  // The control register of what computes with doubles, which fesetround() sets, too: fegetround() in each sweep was a
  // tenth of the time of a star that is pushed through.
  static constexpr unsigned subnormals_are_zero = 0x0040, rounding = 0x6000, flush_to_zero = 0x8000,
                            not_nearest = subnormals_are_zero | rounding | flush_to_zero;
  using State = unsigned;
  static State state() {
    return _mm_getcsr();
  }
  static bool is_nearest(State state) {
    return (state & not_nearest) == 0;
  }
#else
  using State = int;
  static State state() {
    return std::fegetround();
  }
  static bool is_nearest(State state) {
    return state == FE_TONEAREST;
  }
#endif
  State was_;
  bool changed_;
  int mode_ = 0; ///< as the C library names it

  void set_nearest() {
    mode_ = std::fegetround();
    std::fesetround(FE_TONEAREST);
#if defined(__SSE2__)
    _mm_setcsr(was_ & ~not_nearest);
#endif
  }
  void set_back() {
    std::fesetround(mode_);
#if defined(__SSE2__)
    _mm_setcsr(was_);
#endif
  }
};

/// A number that a function gives back that begins with a Rounding_to_nearest: worked out before that ends. To
/// compilers all modes are one, and inlined they work it out where it is used.
inline double kept(double x) {
#if defined(__GNUC__)
#if defined(__SSE2__)
  asm volatile("" : "+x"(x));
#else
  asm volatile("" : "+m"(x));
#endif
#endif
  return x;
}

} // namespace haptic_sculpt::internal
