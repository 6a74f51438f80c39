// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpfr.h>

namespace haptic_sculpt::benchmark {

/// MPFR arithmetic with a fixed number of bits, rounded to nearest. The significand lives in the object: no allocation.
template <int bits> class Mpfr_number {
public:
  Mpfr_number(double value = 0) {
    initialise();
    mpfr_set_d(m_number, value, MPFR_RNDN);
  }
  Mpfr_number(const Mpfr_number& other) {
    initialise();
    mpfr_set(m_number, other.m_number, MPFR_RNDN);
  }
  Mpfr_number& operator=(const Mpfr_number& other) {
    mpfr_set(m_number, other.m_number, MPFR_RNDN);
    return *this;
  }

  friend Mpfr_number operator+(const Mpfr_number& a, const Mpfr_number& b) { return apply(mpfr_add, a, b); }
  friend Mpfr_number operator-(const Mpfr_number& a, const Mpfr_number& b) { return apply(mpfr_sub, a, b); }
  friend Mpfr_number operator*(const Mpfr_number& a, const Mpfr_number& b) { return apply(mpfr_mul, a, b); }
  friend Mpfr_number operator/(const Mpfr_number& a, const Mpfr_number& b) { return apply(mpfr_div, a, b); }
  friend bool operator<(const Mpfr_number& a, const Mpfr_number& b) { return mpfr_less_p(a.m_number, b.m_number) != 0; }
  friend int sign_of(const Mpfr_number& a) { return mpfr_nan_p(a.m_number) ? 0 : mpfr_sgn(a.m_number); }
  friend double as_double(const Mpfr_number& a) { return mpfr_get_d(a.m_number, MPFR_RNDN); }

private:
  void initialise() {
    mpfr_custom_init(m_limbs, bits);
    mpfr_custom_init_set(m_number, MPFR_ZERO_KIND, 0, bits, m_limbs);
  }
  template <class Operation> static Mpfr_number apply(Operation operation, const Mpfr_number& a, const Mpfr_number& b) {
    Mpfr_number result;
    operation(result.m_number, a.m_number, b.m_number, MPFR_RNDN);
    return result;
  }

  mpfr_t m_number;
  mp_limb_t m_limbs[(bits + GMP_NUMB_BITS - 1) / GMP_NUMB_BITS];
};

} // namespace haptic_sculpt::benchmark
