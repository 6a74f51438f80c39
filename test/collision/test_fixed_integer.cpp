// SPDX-License-Identifier: GPL-3.0-or-later
// Fixed-width integers and the doubles they come from, against GMP.
#include <haptic_sculpt/collision/arithmetic/exact_integers.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <gmpxx.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace haptic_sculpt::internal;

namespace {

/// `integer / 2^bits` in lowest terms.
mpq_class fraction(const mpz_class& integer, unsigned bits) {
  mpq_class value(integer, mpz_class(1) << bits);
  value.canonicalize();
  return value;
}

template <std::size_t limbs>
mpz_class to_gmp(const Fixed_integer<limbs>& x) {
  mpz_class value;
  mpz_import(value.get_mpz_t(), limbs, -1, sizeof(std::uint64_t), 0, 0, x.limb.data());
  if (x.is_negative())
    value -= mpz_class(1) << (64 * limbs);
  return value;
}

/// Limbs of zeros, ones and random bits: carries and borrows have to run through all of them.
template <std::size_t limbs>
Fixed_integer<limbs> random_integer(std::mt19937_64& generator) {
  Fixed_integer<limbs> x;
  for (std::uint64_t& limb : x.limb) {
    const std::uint64_t kind = generator() % 4;
    limb = kind == 0   ? 0
           : kind == 1 ? ~std::uint64_t{0}
           : kind == 2 ? std::uint64_t{1} << (generator() % 64)
                       : generator();
  }
  return x;
}

template <std::size_t m, std::size_t n>
void check_product(std::mt19937_64& generator) {
  const auto a = random_integer<m>(generator);
  const auto b = random_integer<n>(generator);
  BOOST_TEST((to_gmp(a * b) == to_gmp(a) * to_gmp(b)));
  BOOST_TEST((a * b).sign() == sgn(to_gmp(a) * to_gmp(b)));
}

template <std::size_t limbs>
void check_sum(std::mt19937_64& generator) {
  const auto a = widened<limbs + 1>(random_integer<limbs>(generator));
  const auto b = widened<limbs + 1>(random_integer<limbs>(generator));
  BOOST_TEST((to_gmp(a + b) == to_gmp(a) + to_gmp(b)));
  BOOST_TEST((to_gmp(a - b) == to_gmp(a) - to_gmp(b)));
}

} // namespace

BOOST_AUTO_TEST_CASE(fixed_integers_compute_as_gmp_does) {
  std::mt19937_64 generator(haptic_sculpt::test::seed_from_environment(20241));
  for (int i = 0; i < 2000; ++i) {
    check_product<1, 1>(generator);
    check_product<2, 1>(generator);
    check_product<2, 2>(generator);
    check_product<4, 2>(generator);
    check_product<3, 3>(generator);
    check_product<6, 6>(generator);
    check_product<4, 4>(generator);
    check_product<8, 4>(generator);
    check_product<12, 12>(generator);
    check_sum<1>(generator);
    check_sum<3>(generator);
    check_sum<6>(generator);
    check_sum<12>(generator);
  }
}

BOOST_AUTO_TEST_CASE(a_split_double_is_the_double) {
  std::mt19937_64 generator(haptic_sculpt::test::seed_from_environment(20242));
  using limits = std::numeric_limits<double>;
  std::vector<double> values = {0.0,
                                -0.0,
                                1.0,
                                -1.0,
                                limits::max(),
                                limits::lowest(),
                                limits::min(),
                                limits::denorm_min(),
                                -limits::denorm_min(),
                                limits::min() - limits::denorm_min()};
  while (values.size() < 2000) {
    double x;
    const std::uint64_t bits = generator();
    std::memcpy(&x, &bits, sizeof x);
    if (std::isfinite(x))
      values.push_back(x);
  }
  for (double x : values) {
    const Split_double split(x);
    BOOST_TEST(std::ldexp(static_cast<double>(split.mantissa), split.exponent) == x);
    const Big_integer big = Integer_of_double<Big_integer>::convert(x, -1074);
    BOOST_TEST((fraction(mpz_class(big.backend().data()), 1074) == mpq_class(x)));
  }
}

BOOST_AUTO_TEST_CASE(conversion_fills_its_limbs_to_the_documented_spread) {
  const double least = std::nextafter(1.0, 2.0);
  for (double sign : {1.0, -1.0}) {
    const double one_limb = sign * std::ldexp(std::nextafter(2.0, 0.0), one_limb_spread);
    BOOST_TEST(
        (fraction(to_gmp(Integer_of_double<Fixed_integer<1>>::convert(one_limb, -52)), 52) == mpq_class(one_limb)));
    const double two_limbs = sign * std::ldexp(std::nextafter(2.0, 0.0), two_limb_spread);
    BOOST_TEST(
        (fraction(to_gmp(Integer_of_double<Fixed_integer<2>>::convert(two_limbs, -52)), 52) == mpq_class(two_limbs)));
    BOOST_TEST((fraction(to_gmp(Integer_of_double<Fixed_integer<2>>::convert(sign * least, -52)), 52) ==
                mpq_class(sign * least)));
    for (int shift = 0; shift <= four_limb_spread; ++shift)
      for (const double x : {std::nextafter(2.0, 0.0), least, 1.0}) {
        const double four_limbs = sign * std::ldexp(x, shift);
        BOOST_TEST((fraction(to_gmp(Integer_of_double<Fixed_integer<4>>::convert(four_limbs, -52)), 52) ==
                    mpq_class(four_limbs)));
      }
  }
}
