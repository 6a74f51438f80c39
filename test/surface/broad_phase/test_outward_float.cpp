// SPDX-License-Identifier: GPL-3.0-or-later
// Floats around doubles, which the boxes of the tree are made of.
#include "surface/broad_phase/random_points.h"

#include <haptic_sculpt/surface/broad_phase/outward_float.h>

#include <boost/test/unit_test.hpp>

#include <cfenv>
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
