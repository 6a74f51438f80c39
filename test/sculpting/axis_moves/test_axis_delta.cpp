// SPDX-License-Identifier: GPL-3.0-or-later
// The delta rule along an axis move against the least value of each quadratic, in rational numbers.
#include "sculpting/Random_scene.h"

#include <haptic_sculpt/sculpting/axis_moves/axis_delta.h>

#include <boost/test/unit_test.hpp>
#include <gmpxx.h>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Motion = internal::Axis_motion<3>;

struct Squares {
  mpq_class normal = 0, side = 0;
};

/// From the points at a time.
Squares squares(const Motion& motion, int side, const mpq_class& t) {
  std::array<std::array<mpq_class, 3>, 3> p;
  for (int v = 0; v < 3; ++v)
    for (int k = 0; k < 3; ++k)
      p[v][k] = (1 - t) * mpq_class(motion.start(v)[k]) + t * mpq_class(motion.end(v)[k]);
  Squares all;
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    const mpq_class n = (p[1][l] - p[0][l]) * (p[2][m] - p[0][m]) - (p[1][m] - p[0][m]) * (p[2][l] - p[0][l]);
    const mpq_class s = p[(side + 1) % 3][k] - p[side][k];
    all.normal += n * n, all.side += s * s;
  }
  return all;
}

/// A number with the sign of what an altitude is more than it has to be: delta, or what it was at the start, if that is
/// less.
mpq_class excess(const Motion& motion, const mpq_class& delta, int side, const mpq_class& t) {
  const Squares start = squares(motion, side, 0), now = squares(motion, side, t);
  const mpq_class square = delta * delta;
  if (start.normal < square * start.side)
    return now.normal * start.side - start.normal * now.side;
  return now.normal - square * now.side;
}

bool is_low(const Motion& motion, const mpq_class& delta) {
  for (int side = 0; side < 3; ++side)
    if (const Squares start = squares(motion, side, 0); start.normal < delta * delta * start.side)
      return true;
  return false;
}

/// Through three of its values.
bool is_kept(const Motion& motion, double delta) {
  for (int side = 0; side < 3; ++side) {
    const mpq_class at_0 = excess(motion, delta, side, 0), at_1 = excess(motion, delta, side, 1),
                    at_2 = excess(motion, delta, side, 2);
    const mpq_class a = (at_2 - 2 * at_1 + at_0) / 2, b = at_1 - at_0 - a;
    mpq_class least = std::min(at_0, at_1);
    if (a > 0 && b < 0 && -b < 2 * a)
      least = std::min(least, mpq_class(at_0 - b * b / (4 * a)));
    if (least < 0)
      return false;
  }
  return true;
}

} // namespace

BOOST_AUTO_TEST_CASE(delta_is_kept_all_along_an_axis) {
  Random random(seed_from_environment(4));
  std::size_t wrong = 0, kept = 0, kept_low = 0, low = 0, dips = 0;
  constexpr std::size_t motions = 10000;
  for (std::size_t i = 0; i < motions; ++i) {
    const int size = 1 + static_cast<int>(random() % 5);
    const double unit = std::array{1.0, 1.0, 0x1p-500, 0x1p900}[random() % 4];
    const auto coordinate = [&] { return unit * (static_cast<double>(random() % (2 * size + 1)) - size); };
    std::array<internal::Coordinates, 3> start;
    for (auto& p : start)
      for (double& c : p)
        c = coordinate();
    const int axis = static_cast<int>(random() % 3);
    std::array<double, 3> end{coordinate(), coordinate(), coordinate()};
    if (random() % 4 == 0) { // all by the same way, or by none
      const double way = random() % 2 == 0 ? coordinate() : 0;
      for (int v = 0; v < 3; ++v)
        end[v] = start[v][axis] + way;
    }
    const Motion motion(axis, start, end);
    double delta = unit * static_cast<double>(1 + random() % 8) / 4;
    if (random() % 4 == 0)
      delta = std::nextafter(delta, 0.0);
    const bool expected = is_kept(motion, delta);
    const bool was_low = is_low(motion, delta);
    kept += expected, low += was_low, kept_low += expected && was_low;
    wrong += internal::is_delta_kept(motion, delta) != expected;
    bool is_kept_at_ends = true;
    for (int side = 0; side < 3; ++side)
      is_kept_at_ends &= excess(motion, delta, side, 0) >= 0 && excess(motion, delta, side, 1) >= 0;
    dips += is_kept_at_ends && !expected;
  }
  BOOST_TEST_MESSAGE(motions << " motions, " << kept << " keep the rule, " << dips << " only at both ends; " << low
                             << " are low at the start, of which " << kept_low << " keep it");
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(kept - kept_low > motions / 50);
  BOOST_TEST(kept_low > motions / 50);
  BOOST_TEST(low - kept_low > motions / 50);
  BOOST_TEST(dips > motions / 500);
}
