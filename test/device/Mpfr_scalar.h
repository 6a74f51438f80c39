// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <mpfr.h>
#include <type_traits>

/// A multiprecision number for the device's templates, and no more than they ask of one: the four operations,
/// comparisons, a handful of functions. Boost's numbers serve as well, but their hundred operator templates are looked
/// through at every operator, which takes the compiler more time than all the rest.
namespace device_populations {

/// MPFR arithmetic of this many bits, rounded to nearest. The significand lives in the object: no allocation. What
/// makes a number is not inlined: a call more is little beside MPFR's own, and much less to compile.
template <int bits>
class Mpfr_scalar {
public:
  Mpfr_scalar() { initialise(); }
  template <class T, typename = std::enable_if_t<std::is_arithmetic<T>::value>>
  Mpfr_scalar(T value) {
    initialise();
    if constexpr (std::is_integral<T>::value)
      mpfr_set_si(number_, static_cast<long>(value), MPFR_RNDN);
    else
      mpfr_set_ld(number_, static_cast<long double>(value), MPFR_RNDN);
  }
  __attribute__((noinline)) Mpfr_scalar(const Mpfr_scalar& other) {
    initialise();
    mpfr_set(number_, other.number_, MPFR_RNDN);
  }
  template <int other_bits>
  explicit Mpfr_scalar(const Mpfr_scalar<other_bits>& other) {
    initialise();
    mpfr_set(number_, other.number_, MPFR_RNDN);
  }
  __attribute__((noinline)) Mpfr_scalar& operator=(const Mpfr_scalar& other) {
    mpfr_set(number_, other.number_, MPFR_RNDN);
    return *this;
  }
  explicit operator double() const { return mpfr_get_d(number_, MPFR_RNDN); }
  explicit operator float() const { return mpfr_get_flt(number_, MPFR_RNDN); }
  explicit operator long double() const { return mpfr_get_ld(number_, MPFR_RNDN); }

  Mpfr_scalar& operator+=(const Mpfr_scalar& b) { return mpfr_add(number_, number_, b.number_, MPFR_RNDN), *this; }
  Mpfr_scalar& operator-=(const Mpfr_scalar& b) { return mpfr_sub(number_, number_, b.number_, MPFR_RNDN), *this; }
  Mpfr_scalar& operator*=(const Mpfr_scalar& b) { return mpfr_mul(number_, number_, b.number_, MPFR_RNDN), *this; }
  Mpfr_scalar& operator/=(const Mpfr_scalar& b) { return mpfr_div(number_, number_, b.number_, MPFR_RNDN), *this; }

  friend Mpfr_scalar operator+(const Mpfr_scalar& a, const Mpfr_scalar& b) { return binary(mpfr_add, a, b); }
  friend Mpfr_scalar operator-(const Mpfr_scalar& a, const Mpfr_scalar& b) { return binary(mpfr_sub, a, b); }
  friend Mpfr_scalar operator*(const Mpfr_scalar& a, const Mpfr_scalar& b) { return binary(mpfr_mul, a, b); }
  friend Mpfr_scalar operator/(const Mpfr_scalar& a, const Mpfr_scalar& b) { return binary(mpfr_div, a, b); }
  friend Mpfr_scalar operator-(const Mpfr_scalar& a) { return unary(mpfr_neg, a); }
  friend Mpfr_scalar abs(const Mpfr_scalar& a) { return unary(mpfr_abs, a); }
  friend Mpfr_scalar sqrt(const Mpfr_scalar& a) { return unary(mpfr_sqrt, a); }
  friend Mpfr_scalar sin(const Mpfr_scalar& a) { return unary(mpfr_sin, a); }
  friend Mpfr_scalar cos(const Mpfr_scalar& a) { return unary(mpfr_cos, a); }
  friend Mpfr_scalar atan2(const Mpfr_scalar& y, const Mpfr_scalar& x) { return binary(mpfr_atan2, y, x); }

  friend bool operator<(const Mpfr_scalar& a, const Mpfr_scalar& b) { return mpfr_less_p(a.number_, b.number_) != 0; }
  friend bool operator>(const Mpfr_scalar& a, const Mpfr_scalar& b) { return b < a; }
  friend bool operator<=(const Mpfr_scalar& a, const Mpfr_scalar& b) {
    return mpfr_lessequal_p(a.number_, b.number_) != 0;
  }
  friend bool operator>=(const Mpfr_scalar& a, const Mpfr_scalar& b) { return b <= a; }
  friend bool operator==(const Mpfr_scalar& a, const Mpfr_scalar& b) { return mpfr_equal_p(a.number_, b.number_) != 0; }
  friend bool operator!=(const Mpfr_scalar& a, const Mpfr_scalar& b) { return !(a == b); }

  static Mpfr_scalar infinity() {
    Mpfr_scalar a;
    mpfr_set_inf(a.number_, 1);
    return a;
  }
  static Mpfr_scalar not_a_number() {
    Mpfr_scalar a;
    mpfr_set_nan(a.number_);
    return a;
  }
  static Mpfr_scalar greatest() {
    Mpfr_scalar a = infinity();
    mpfr_nextbelow(a.number_);
    return a;
  }
  static Mpfr_scalar least() {
    Mpfr_scalar a;
    mpfr_nextabove(a.number_);
    return a;
  }
  static Mpfr_scalar power_of_two(long exponent) {
    Mpfr_scalar a;
    mpfr_set_si_2exp(a.number_, 1, exponent, MPFR_RNDN);
    return a;
  }

private:
  template <int>
  friend class Mpfr_scalar;
  void initialise() {
    mpfr_custom_init(limbs_, bits);
    mpfr_custom_init_set(number_, MPFR_ZERO_KIND, 0, bits, limbs_);
  }
  template <class Operation>
  __attribute__((noinline)) static Mpfr_scalar unary(Operation operation, const Mpfr_scalar& a) {
    Mpfr_scalar result;
    operation(result.number_, a.number_, MPFR_RNDN);
    return result;
  }
  template <class Operation>
  __attribute__((noinline)) static Mpfr_scalar binary(Operation operation, const Mpfr_scalar& a, const Mpfr_scalar& b) {
    Mpfr_scalar result;
    operation(result.number_, a.number_, b.number_, MPFR_RNDN);
    return result;
  }

  mpfr_t number_;
  mp_limb_t limbs_[(bits + GMP_NUMB_BITS - 1) / GMP_NUMB_BITS];
};

/// The number of at least this many decimal digits.
template <int digits>
using Mpfr = Mpfr_scalar<digits * 1000 / 301 + 2>;

} // namespace device_populations

template <int bits>
class std::numeric_limits<device_populations::Mpfr_scalar<bits>> {
  using Scalar = device_populations::Mpfr_scalar<bits>;

public:
  static constexpr bool is_specialized = true, is_signed = true, is_integer = false, is_exact = false;
  static constexpr int digits = bits, digits10 = (bits - 1) * 301 / 1000, radix = 2;
  static Scalar epsilon() { return Scalar::power_of_two(1 - bits); }
  static Scalar max() { return Scalar::greatest(); }
  static Scalar min() { return Scalar::least(); }
  static Scalar lowest() { return -Scalar::greatest(); }
  static Scalar infinity() { return Scalar::infinity(); }
  static Scalar quiet_NaN() { return Scalar::not_a_number(); }
};

template <int bits>
struct Eigen::NumTraits<device_populations::Mpfr_scalar<bits>>
    : Eigen::GenericNumTraits<device_populations::Mpfr_scalar<bits>> {
  enum {
    IsInteger = 0,
    IsSigned = 1,
    IsComplex = 0,
    RequireInitialization = 1,
    ReadCost = 8,
    AddCost = 40,
    MulCost = 80
  };
};
