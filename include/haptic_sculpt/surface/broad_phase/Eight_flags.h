// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace haptic_sculpt::internal {

/// Eight answers to one question. Compilers make thrice the code of a loop over eight comparisons.
class Eight_flags {
public:
  /// Whether a > b, which are eight numbers or one for all eight; not where one of them is not a number.
  template <class A, class B>
  static Eight_flags greater(const A& a, const B& b) {
    Eight_flags flags;
#if defined(__SSE__)
    for (int i = 0; i < 2; ++i)
      flags.four_[i] = _mm_cmpgt_ps(four(a, i), four(b, i));
#else
    for (int j = 0; j < 8; ++j)
      flags.mask_ |= one(a, j) > one(b, j) ? 1u << j : 0u;
#endif
    return flags;
  }

  friend Eight_flags operator|(Eight_flags a, const Eight_flags& b) {
#if defined(__SSE__)
    for (int i = 0; i < 2; ++i)
      a.four_[i] = _mm_or_ps(a.four_[i], b.four_[i]);
#else
    a.mask_ |= b.mask_;
#endif
    return a;
  }
  friend Eight_flags operator&(Eight_flags a, const Eight_flags& b) {
#if defined(__SSE__)
    for (int i = 0; i < 2; ++i)
      a.four_[i] = _mm_and_ps(a.four_[i], b.four_[i]);
#else
    a.mask_ &= b.mask_;
#endif
    return a;
  }

  /// Bit j: whether the answer to j is no.
  unsigned where_not() const {
#if defined(__SSE__)
    return static_cast<unsigned>(_mm_movemask_ps(four_[0]) | _mm_movemask_ps(four_[1]) << 4) ^ 255u;
#else
    return mask_ ^ 255u;
#endif
  }

private:
#if defined(__SSE__)
  __m128 four_[2];

  static __m128 four(const float (&numbers)[8], int i) { return _mm_loadu_ps(numbers + 4 * i); }
  static __m128 four(float number, int) { return _mm_set1_ps(number); }
#else
  unsigned mask_ = 0;

  static float one(const float (&numbers)[8], int j) { return numbers[j]; }
  static float one(float number, int) { return number; }
#endif
};

} // namespace haptic_sculpt::internal
