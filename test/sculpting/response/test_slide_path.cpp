// SPDX-License-Identifier: GPL-3.0-or-later
// A path made shorter begins and ends where it did, and each of its legs is an old one or has been found free.
#include <haptic_sculpt/sculpting/response/Slide_path.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstring>
#include <random>
#include <set>
#include <utility>
#include <vector>

using haptic_sculpt::internal::Slide_path;
using haptic_sculpt::internal::Vector;
using Ways = Slide_path::Ways;

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr Vector origin = {0, 0, 0};

Slide_path path_of(const std::vector<Vector>& points) {
  Slide_path path(points[0]);
  for (std::size_t i = 1; i < points.size(); ++i)
    path.add(points[i]);
  return path;
}

/// Whether the segment keeps out of the cylinder of radius 1 about the third axis.
bool is_free_of_cylinder(const Vector& a, const Vector& b) {
  const double x = b[0] - a[0], y = b[1] - a[1], square = x * x + y * y;
  const double t = square > 0 ? std::fmin(1, std::fmax(0, -(a[0] * x + a[1] * y) / square)) : 0;
  return std::hypot(a[0] + t * x, a[1] + t * y) > 1;
}

struct Outcome {
  Slide_path path;
  std::size_t asked = 0, not_proven = 0;
  bool ends_stay = false, says_fewer = false;
};

/// Shortens and looks at every leg that is left.
template <class Is_free>
Outcome shortened(const std::vector<Vector>& points, const Is_free& is_free, Ways ways, int enough) {
  std::set<std::pair<Vector, Vector>> proven;
  for (std::size_t i = 1; i < points.size(); ++i)
    proven.emplace(points[i - 1], points[i]);
  Outcome outcome{path_of(points)};
  outcome.says_fewer = outcome.path.shorten(
      origin,
      [&](const Vector& a, const Vector& b) {
        ++outcome.asked;
        const bool free = is_free(a, b);
        if (free)
          proven.emplace(a, b);
        return free;
      },
      ways, enough);
  for (int i = 0; i < outcome.path.legs(); ++i)
    outcome.not_proven += proven.count({outcome.path.point(i), outcome.path.point(i + 1)}) == 0;
  outcome.ends_stay = std::memcmp(&outcome.path.point(0), &points.front(), sizeof(Vector)) == 0 &&
                      std::memcmp(&outcome.path.end(), &points.back(), sizeof(Vector)) == 0;
  return outcome;
}

/// `legs` legs around the cylinder, as close as chords of that many can be.
std::vector<Vector> around_cylinder(int legs, double angle, double from, double rise) {
  const double radius = 1.0001 / std::cos(angle / legs / 2);
  std::vector<Vector> points;
  for (int i = 0; i <= legs; ++i)
    points.push_back(
        {radius * std::cos(from + angle * i / legs), radius * std::sin(from + angle * i / legs), rise * i});
  return points;
}

} // namespace

BOOST_AUTO_TEST_CASE(paths_half_round_a_cylinder_become_short) {
  std::mt19937_64 random(haptic_sculpt::test::seed_from_environment(512));
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int most_bent = 0, most_straight = 0;
  for (int i = 0; i < 2000; ++i) {
    const int legs = 1 + static_cast<int>(random() % Slide_path::most_legs),
              enough = 1 + static_cast<int>(random() % 8);
    const auto points = around_cylinder(legs, number(0.1, pi), number(0, 2 * pi), number(-0.1, 0.1));
    for (const Ways ways : {Ways::straight, Ways::straight_and_bent}) {
      const Outcome outcome = shortened(points, is_free_of_cylinder, ways, enough);
      BOOST_TEST_REQUIRE(outcome.ends_stay);
      BOOST_TEST_REQUIRE(outcome.not_proven == 0u);
      BOOST_TEST_REQUIRE(outcome.path.legs() <= legs);
      BOOST_TEST_REQUIRE(outcome.says_fewer == (outcome.path.legs() < legs));
      if (legs <= enough)
        BOOST_TEST_REQUIRE(outcome.asked == 0u);
      int& most = ways == Ways::straight ? most_straight : most_bent;
      most = std::max(most, outcome.path.legs());
    }
  }
  BOOST_TEST_MESSAGE("half round a cylinder at most " << most_straight << " legs straight, " << most_bent << " bent");
  BOOST_TEST(most_bent <= 8);
  BOOST_TEST(most_straight > 8); // chords do not do
}

BOOST_AUTO_TEST_CASE(steps_of_an_ulp_over_a_plane_become_one_leg) {
  std::mt19937_64 random(haptic_sculpt::test::seed_from_environment(513));
  std::vector<Vector> points = {{-1, -1, 1}};
  for (int i = 0; i < 7; ++i)
    points.push_back({0.5, 0.5, 1e-15 * static_cast<double>(1 + random() % 8)});
  const Outcome outcome = shortened(
      points, [](const Vector& a, const Vector& b) { return a[2] > 0 && b[2] > 0; }, Ways::straight, 4);
  BOOST_TEST(outcome.path.legs() == 1);
  BOOST_TEST(outcome.asked == 1u);
  BOOST_TEST(outcome.ends_stay);
}

BOOST_AUTO_TEST_CASE(where_nothing_is_free_the_path_stays_and_little_is_asked) {
  const auto points = around_cylinder(Slide_path::most_legs, 6, 0, 0.01);
  const auto never = [](const Vector&, const Vector&) { return false; };
  const Outcome straight = shortened(points, never, Ways::straight, 4),
                bent = shortened(points, never, Ways::straight_and_bent, 4);
  BOOST_TEST_MESSAGE(straight.asked << " ways asked for, " << bent.asked << " with bent ones");
  for (const Outcome& outcome : {straight, bent}) {
    BOOST_TEST(!outcome.says_fewer);
    BOOST_TEST(outcome.path.legs() == Slide_path::most_legs);
    for (int i = 0; i <= Slide_path::most_legs; ++i)
      BOOST_TEST(outcome.path.point(i) == points[static_cast<std::size_t>(i)]);
  }
  BOOST_TEST(straight.asked <= 103u);
  BOOST_TEST(bent.asked <= 400u);
}
