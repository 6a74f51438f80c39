// SPDX-License-Identifier: GPL-3.0-or-later
// Floats around doubles, which the boxes of the tree are made of.
#include "surface/broad_phase/random_points.h"

#include <haptic_sculpt/surface/broad_phase/Box_scale.h>

#include <boost/test/unit_test.hpp>

#include <cfenv>
#include <gmpxx.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace haptic_sculpt;
using namespace broad_phase_tests;

BOOST_AUTO_TEST_CASE(rounding_is_outward_and_tight_in_every_mode) {
  Random random(seed());
  std::vector<double> values = {0.0,   -0.0,   1e-320, -1e-320, 1e-46, -1e-46,    1e39,
                                -1e39, 3.5e38, 1e308,  0.1,     -0.1,  16777217.0};
  for (const float f : {1.f, 1e-45f, 1e-38f, std::numeric_limits<float>::max(), std::numeric_limits<float>::min()})
    for (const double x : {double(f), std::nextafter(double(f), 0.0), std::nextafter(double(f), 1e300)})
      values.push_back(x), values.push_back(-x);
  for (int k = 0; k < 20000; ++k)
    values.push_back(std::ldexp(uniform(random), static_cast<int>(random() % 700) - 350));
  for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    std::size_t wrong = 0;
    for (const double x : values) {
      const float below = internal::float_below(x), above = internal::float_above(x);
      wrong += !(double(below) <= x && double(above) >= x);
      // At most one float away on each side.
      wrong += !(double(std::nextafterf(below, std::numeric_limits<float>::infinity())) >= x);
      wrong += !(double(std::nextafterf(above, -std::numeric_limits<float>::infinity())) <= x);
    }
    std::fesetround(FE_TONEAREST);
    BOOST_TEST(wrong == 0u);
  }
}

/// The product as a rational number.
static mpq_class multiplied(double x, double power_of_two) { return mpq_class(x) * mpq_class(power_of_two); }

BOOST_AUTO_TEST_CASE(scaled_boxes_are_outward_whatever_overflows_or_underflows) {
  Random random(seed());
  constexpr double largest = std::numeric_limits<double>::max();
  std::vector<double> values = {0.0,       -0.0,       5e-324,  -5e-324,  2e-323,   -2e-323,
                                0x1p-1022, -0x1p-1022, largest, -largest, 0x1p1000, -0x1p1000};
  for (int k = 0; k < 5000; ++k)
    values.push_back(std::ldexp(uniform(random), static_cast<int>(random() % 2090) - 1070));
  for (const int exponent : {-1074, -1073, -1022, -600, -150, -1, 0, 1, 128, 500, 999, 1000, 1023}) {
    const internal::Box_scale scale([&](const auto& visit) {
      visit(Box_3::Coordinates{0, -std::ldexp(1.0, exponent), 0});
    });
    // The scene is brought to 1 as far as the factor and its inverse are normal numbers.
    BOOST_TEST(scale.factor() == std::ldexp(1.0, std::max(-1000, std::min(1000, -exponent))));
    std::vector<mpq_class> exact;
    for (const double x : values)
      exact.push_back(multiplied(x, scale.factor()));
    for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
      std::fesetround(mode);
      std::vector<std::array<float, 4>> found;
      for (const double x : values) {
        const internal::Float_box box = scale.around(Box_3({x, x, x})), query = scale.query(Box_3({x, x, x}));
        found.push_back({box.lower[0], box.upper[0], query.lower[1], query.upper[1]});
      }
      std::fesetround(FE_TONEAREST);
      std::size_t wrong = 0;
      for (std::size_t k = 0; k < values.size(); ++k) {
        const auto [lower, upper, least, most] = found[k];
        const auto is_at_most = [](float a, const mpq_class& b) { return std::isinf(a) ? a < 0 : mpq_class(a) <= b; };
        wrong += !is_at_most(lower, exact[k]) || !is_at_most(-upper, -exact[k]);
        // What is asked for is met, by its own box and by one that is as wide as there are: nothing is lost at the
        // ends.
        wrong += !(lower <= most && upper >= least);
      }
      BOOST_TEST(wrong == 0u);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_unit_of_boxes_is_that_of_the_middle_point) {
  const auto factor = [](const std::vector<double>& sizes) {
    return internal::Box_scale([&](const auto& visit) {
             for (const double size : sizes)
               visit(Box_3::Coordinates{size / 2, 0, -size});
           }).factor();
  };
  BOOST_TEST(factor({}) == 1);
  BOOST_TEST(factor({0, 0, 0}) == 1);
  BOOST_TEST(factor({0, 0, 0, 8}) == 0.125);
  BOOST_TEST(factor({1e300, 1, 1.5, 1.25, 1e-300}) == 1); // what is far out takes nothing from the others
}
