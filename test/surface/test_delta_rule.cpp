// SPDX-License-Identifier: GPL-3.0-or-later
#include <haptic_sculpt/surface/delta_rule.h>

#include <boost/test/unit_test.hpp>

#include <gmpxx.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_3 = Kernel::Point_3;
using haptic_sculpt::Satisfies_delta_rule_3;

/// The three altitudes, one by one, squared, as rationals.
bool by_rationals(double delta, const Point_3& a, const Point_3& b, const Point_3& c) {
  const Point_3* p[3] = {&a, &b, &c};
  for (int i = 0; i < 3; ++i) {
    const Point_3 &apex = *p[i], &from = *p[(i + 1) % 3], &to = *p[(i + 2) % 3];
    mpq_class edge[3], arm[3], length = 0, along = 0, reach = 0;
    for (int k = 0; k < 3; ++k) {
      edge[k] = mpq_class(to[k]) - mpq_class(from[k]);
      arm[k] = mpq_class(apex[k]) - mpq_class(from[k]);
      length += edge[k] * edge[k];
      along += edge[k] * arm[k];
      reach += arm[k] * arm[k];
    }
    if (length == 0)
      return false;
    const mpq_class altitude = reach - along * along / length;
    const mpq_class bound = mpq_class(delta) * mpq_class(delta);
    if (altitude == 0 || altitude < bound)
      return false;
  }
  return true;
}

} // namespace

BOOST_AUTO_TEST_SUITE(delta_rule)

BOOST_AUTO_TEST_CASE(an_altitude_of_exactly_delta_is_allowed) {
  const Point_3 a(0, 0, 0), b(4, 0, 0), c(1, 0.25, 0);
  BOOST_TEST(Satisfies_delta_rule_3<Kernel>(0.25)(a, b, c));
  BOOST_TEST(!Satisfies_delta_rule_3<Kernel>(std::nextafter(0.25, 1))(a, b, c));
  BOOST_TEST(Satisfies_delta_rule_3<Kernel>(std::nextafter(0.25, 0))(c, a, b));
}

BOOST_AUTO_TEST_CASE(delta_zero_forbids_the_line_and_nothing_else) {
  const Satisfies_delta_rule_3<Kernel> rule;
  const double tiny = std::numeric_limits<double>::denorm_min(), huge = std::numeric_limits<double>::max();
  BOOST_TEST(!rule(Point_3(0, 0, 0), Point_3(1, 1, 1), Point_3(3, 3, 3)));
  BOOST_TEST(!rule(Point_3(1, 2, 3), Point_3(1, 2, 3), Point_3(1, 2, 3)));
  BOOST_TEST(rule(Point_3(0, 0, 0), Point_3(huge, 0, 0), Point_3(0, tiny, 0)));
  BOOST_TEST(rule(Point_3(0, 0, 0), Point_3(tiny, 0, 0), Point_3(0, tiny, 0)));
  BOOST_TEST(!Satisfies_delta_rule_3<Kernel>(1)(Point_3(1, 2, 3), Point_3(1, 2, 3), Point_3(1, 2, 3)));
}

BOOST_AUTO_TEST_CASE(agrees_with_rationals) {
  constexpr unsigned seed = 20240501;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937_64 random(seed);
  std::size_t allowed = 0, wrong = 0, asked = 0;
  const auto ask = [&](double delta, const Point_3& a, const Point_3& b, const Point_3& c) {
    const bool expected = by_rationals(delta, a, b, c);
    allowed += expected;
    wrong += Satisfies_delta_rule_3<Kernel>(delta)(a, b, c) != expected;
    ++asked;
  };
  // Altitudes of exactly delta, and one bit beside it, on grids; then wide exponents, subnormals included.
  for (int i = 0; i < 4000; ++i) {
    const auto grid = [&] { return static_cast<double>(static_cast<int>(random() % 9) - 4); };
    const Point_3 a(grid(), grid(), grid()), b(grid(), grid(), grid()), c(grid(), grid(), grid());
    for (const double delta : {0.0, 1.0, 2.0, 0.5, std::nextafter(1.0, 2), std::nextafter(1.0, 0)})
      ask(delta, a, b, c);
    const double height = std::sqrt(2.0) * (1 + i % 5); // as near to the bound as doubles come
    ask(height, Point_3(0, 0, 0), Point_3(7, 7, 0), Point_3(grid(), grid(), 0));
  }
  for (int i = 0; i < 4000; ++i) {
    const int low = i % 2 ? -1074 : -30, high = i % 2 ? 1000 : 30;
    const auto wide = [&] {
      const int exponent = low + static_cast<int>(random() % (high - low));
      return std::ldexp(static_cast<double>(static_cast<std::int64_t>(random()) >> 11), exponent - 52);
    };
    ask(std::abs(wide()), Point_3(wide(), wide(), wide()), Point_3(wide(), wide(), wide()),
        Point_3(wide(), wide(), wide()));
  }
  BOOST_TEST_MESSAGE(asked << " triangles, " << allowed << " allowed");
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(allowed > asked / 10);
  BOOST_TEST(allowed < asked * 9 / 10);
}

BOOST_AUTO_TEST_SUITE_END()
