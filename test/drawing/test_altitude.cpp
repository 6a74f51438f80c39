// SPDX-License-Identifier: GPL-3.0-or-later
// Altitudes of needles, of any size, beside their squares in rationals.
#include <drawing/altitude.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <random>

using Eigen::Vector3d;

namespace {

/// (b - a) x (c - a) squared over (b - a) squared.
mpq_class squared_altitude(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const auto d = [&a](const Vector3d& p, int i) { return mpq_class(mpq_class(p[i]) - mpq_class(a[i])); };
  mpq_class area = 0, base = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const mpq_class n = d(b, i) * d(c, j) - d(b, j) * d(c, i);
    area += n * n, base += d(b, i) * d(b, i);
  }
  return area / base;
}

} // namespace

BOOST_AUTO_TEST_CASE(altitudes_of_needles_of_any_size_are_right_to_a_millionth) {
  std::mt19937_64 random(haptic_sculpt::test::seed_from_environment(91));
  std::uniform_real_distribution<double> number(-1, 1);
  std::size_t needles = 0, wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    const int k = i % 5 == 0 ? 900 : i % 5 == 1 ? -900 : 0;
    const auto point = [&] {
      const double x = number(random), y = number(random), z = number(random);
      return Vector3d(std::ldexp(x, k), std::ldexp(y, k), std::ldexp(z, k));
    };
    const Vector3d a = point(), b = point();
    Vector3d c = point();
    if (i % 2 == 0) // as near to the line as rounding lets it
      c = a + number(random) * (b - a);
    const double altitude = haptic_sculpt::drawing::altitude(a, b, c);
    const mpq_class square = squared_altitude(a, b, c), found = mpq_class(altitude) * mpq_class(altitude);
    needles += altitude < 1e-15 * (b - a).stableNorm();
    wrong += abs(found - square) > square / 1000000;
  }
  BOOST_TEST_MESSAGE(needles << " needles");
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(needles > 5000u);
  constexpr double least = 0x1p-1074;
  BOOST_TEST(haptic_sculpt::drawing::altitude({0, 0, 0}, {least, least, 0}, {0, 0, 1}) == 1);
  BOOST_TEST(haptic_sculpt::drawing::altitude({0, 0, 0}, {1, 1, 1}, {3, 3, 3}) == 0);
  BOOST_TEST(haptic_sculpt::drawing::altitude({1, 2, 3}, {1, 2, 3}, {3, 3, 3}) == 0);
}
