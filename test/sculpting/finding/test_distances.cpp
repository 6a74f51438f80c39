// SPDX-License-Identifier: GPL-3.0-or-later
// What is decided about distances in integers, against CGAL's distances in rationals: whether a point is as near to a
// triangle, and which of two points is farther from a third. Many have exactly the distance asked for, or an ulp more
// or less.
#include "seeds_and_sizes.h"

#include <haptic_sculpt/sculpting/finding/find_face_within.h>
#include <haptic_sculpt/sculpting/response/is_farther.h>

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include <boost/test/unit_test.hpp>

#include <random>

using haptic_sculpt::internal::Coordinates;

namespace {

using Kernel = CGAL::Simple_cartesian<CGAL::Gmpq>;
using Random = std::mt19937_64;

Kernel::Point_3 exact(const Coordinates& q) { return {q[0], q[1], q[2]}; }

CGAL::Gmpq squared_distance_by_rationals(const Coordinates& p, const Coordinates& a, const Coordinates& b,
                                         const Coordinates& c) {
  return CGAL::squared_distance(exact(p), Kernel::Triangle_3(exact(a), exact(b), exact(c)));
}

/// Whole numbers to 4 that are often equal or in one plane; doubles at random; and these times powers of two that lie
/// up to 2^300 apart.
Coordinates random_place(Random& random, int population) {
  std::uniform_real_distribution<double> number(-1, 1);
  Coordinates q;
  for (double& x : q) {
    x = population == 0 ? static_cast<double>(random() % 9) - 4 : number(random);
    if (population == 2)
      x = std::ldexp(x, static_cast<int>(random() % 300) - 150);
  }
  return q;
}

} // namespace

BOOST_AUTO_TEST_SUITE(distances)

BOOST_AUTO_TEST_CASE(whether_a_point_is_as_near_to_a_triangle) {
  const auto seed = haptic_sculpt::test::seed_from_environment(61);
  Random random(seed);
  std::size_t wrong = 0, within = 0, beyond = 0, exactly = 0, of_a_plane = 0;
  const std::size_t number = haptic_sculpt::test::count_from_environment("HAPTIC_SCULPT_DISTANCES", 30000);
  for (std::size_t n = 0; n < number; ++n) {
    const int population = static_cast<int>(n % 3);
    const Coordinates a = random_place(random, population), b = random_place(random, population),
                      c = random_place(random, population);
    if (CGAL::collinear(exact(a), exact(b), exact(c)))
      continue;
    Coordinates p = random_place(random, population);
    if (random() % 4 == 0) { // in the plane, of whole numbers exactly
      const double u = static_cast<double>(random() % 4) - 1, v = static_cast<double>(random() % 4) - 1;
      for (int i = 0; i < 3; ++i)
        p[i] = a[i] + (u * (b[i] - a[i]) + v * (c[i] - a[i]));
    }
    const CGAL::Gmpq square = squared_distance_by_rationals(p, a, b, c);
    const double near = std::sqrt(CGAL::to_double(square));
    for (const double distance :
         {0.0, std::nextafter(near, 0.0), near, std::nextafter(near, 2 * near), 2 * near, 1.0}) {
      if (!(distance >= 0) || !std::isfinite(distance))
        continue;
      const CGAL::Gmpq limit(distance);
      const auto expected = CGAL::compare(square, CGAL::Gmpq(limit * limit));
      const bool answer = haptic_sculpt::internal::is_within_distance(p, a, b, c, distance);
      wrong += answer != (expected != CGAL::LARGER);
      within += expected == CGAL::SMALLER, beyond += expected == CGAL::LARGER, exactly += expected == CGAL::EQUAL;
      of_a_plane += expected == CGAL::LARGER && CGAL::coplanar(exact(p), exact(a), exact(b), exact(c));
    }
  }
  BOOST_TEST_CONTEXT("seed " << seed) {
    BOOST_TEST(wrong == 0);
    for (const std::size_t count : {within, beyond, exactly, of_a_plane})
      BOOST_TEST(haptic_sculpt::test::is_enough(count, number / 20));
  }
}

BOOST_AUTO_TEST_CASE(which_of_two_is_farther) {
  const auto seed = haptic_sculpt::test::seed_from_environment(62);
  Random random(seed);
  std::size_t wrong = 0, farther = 0, equal = 0;
  const std::size_t number = haptic_sculpt::test::count_from_environment("HAPTIC_SCULPT_DISTANCES", 60000);
  for (std::size_t n = 0; n < number; ++n) {
    const int population = static_cast<int>(n % 3);
    const Coordinates target = random_place(random, population), p = random_place(random, population);
    Coordinates q = random_place(random, population);
    if (random() % 2 == 0) { // as far in exact numbers, where what is subtracted is exact
      q = {target[0] - (p[1] - target[1]), target[1] + (p[2] - target[2]), target[2] - (p[0] - target[0])};
      if (random() % 2 == 0)
        q[0] = std::nextafter(q[0], 1.0);
    }
    const auto expected = CGAL::compare(CGAL::squared_distance(exact(p), exact(target)),
                                        CGAL::squared_distance(exact(q), exact(target)));
    wrong += haptic_sculpt::internal::is_farther(target, p, q) != (expected == CGAL::LARGER);
    farther += expected == CGAL::LARGER, equal += expected == CGAL::EQUAL;
  }
  BOOST_TEST_CONTEXT("seed " << seed) {
    BOOST_TEST(wrong == 0);
    BOOST_TEST(haptic_sculpt::test::is_enough(farther, number / 4));
    BOOST_TEST(haptic_sculpt::test::is_enough(equal, number / 20));
  }
}

BOOST_AUTO_TEST_SUITE_END()
