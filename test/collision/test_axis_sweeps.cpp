// SPDX-License-Identifier: GPL-3.0-or-later
// The axis sweeps against linear feasibility in rational numbers at all critical times and between.
// HAPTIC_SCULPT_AXIS_QUERIES sets how many queries are asked, HAPTIC_SCULPT_SEED which; see doc/use/testing.md.
#include "collision/Sweeps_under_test.h"
#include "oracle/axis_oracle.h"
#include "populations/Portable_random.h"
#include "sculpting/public_functions/Callers_mode.h"

#include <haptic_sculpt/collision/Axis_sweep_traits_3.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>
#include <cfenv>
#include <cmath>
#include <sstream>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Axis_traits = Axis_sweep_traits_3<Kernel, Filter_counters>;

/// As a line that the program `sweep_queries` reads.
std::string line_of(const Axis_query& query) {
  std::ostringstream text;
  text << "AX " << (query.is_vertex_and_face ? "VF " : "EE ") << query.axis << std::hexfloat;
  for (const auto& p : query.start)
    for (const double c : p)
      text << ' ' << c;
  for (const double c : query.end)
    text << ' ' << c;
  return text.str();
}

bool answer(const Axis_traits& traits, const Axis_query& query) {
  const auto p = [&query](int i) { return Kernel::Point_3(query.start[i][0], query.start[i][1], query.start[i][2]); };
  if (query.is_vertex_and_face)
    return traits.vertex_face_axis_sweep_3_object()(query.axis, p(0), p(1), p(2), p(3), query.end);
  return traits.edge_edge_axis_sweep_3_object()(query.axis, p(0), p(1), p(2), p(3), query.end);
}

bool face_answer(const Axis_traits& traits, const Axis_query& query) {
  const auto p = [&query](int i) { return Kernel::Point_3(query.start[i][0], query.start[i][1], query.start[i][2]); };
  return traits.degenerate_face_axis_sweep_3_object()(query.axis, p(1), p(2), p(3),
                                                      {query.end[1], query.end[2], query.end[3]});
}

/// Small integers: most of these features are parallel, vertical, points, or touch.
Axis_query grid_query(Portable_random& random) {
  const int size = random.integer(1, 4);
  Axis_query query{};
  for (auto& p : query.start)
    for (double& c : p)
      c = random.integer(0, size);
  for (double& c : query.end)
    c = random.integer(0, size);
  return query;
}

/// Points of a plane along the axis, or of a line as seen along it, at any heights.
Axis_query vertical_query(Portable_random& random, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3, along = random.integer(-3, 3), across = random.integer(-3, 3);
  Axis_query query = grid_query(random);
  for (auto& p : query.start) {
    const int place = random.integer(0, 3);
    p[i] = 5 + place * along;
    p[j] = -2 + place * across;
  }
  return query;
}

/// Four points of a population of sweeps, in contact, flat or strained; ends at heights of the query, at once or mixed.
Axis_query population_query(std::mt19937_64& engine, Portable_random& random, int axis) {
  const auto& populations = sweep_populations();
  const Sweep_query drawn = populations[engine() % populations.size()](engine);
  Axis_query query{};
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k)
      query.start[i][k] = drawn.x[3 * (i + 1) + k];
  const int way = random.integer(0, 3);
  for (int i = 0; i < 4; ++i) {
    const double here = query.start[i][axis], there = query.start[random.integer(0, 3)][axis];
    const double from = drawn.x[random.integer(0, 14)], to = drawn.x[random.integer(0, 14)];
    query.end[i] = way == 0 ? here : way == 1 ? there : way == 2 ? to : here + (to - from);
  }
  if (random.one_in(2)) { // one point over another, or over the middle of two
    const int a = random.integer(0, 3), b = random.integer(0, 3), c = random.integer(0, 3);
    for (int k = 0; k < 3; ++k)
      if (k != axis)
        query.start[a][k] = query.start[b][k] / 2 + query.start[c][k] / 2;
  }
  for (double& c : query.end)
    c = std::isfinite(c) ? c : 0;
  return query;
}

Axis_query any_query(std::mt19937_64& engine) {
  Portable_random random(engine);
  const int axis = random.integer(0, 2), sort = random.integer(0, 3);
  Axis_query query = sort == 0   ? grid_query(random)
                     : sort == 1 ? vertical_query(random, axis)
                                 : population_query(engine, random, axis);
  query.axis = axis;
  query.is_vertex_and_face = random.one_in(2);
  if (sort < 2 && random.one_in(4)) { // exactly, to the ends of the range
    const double factor = random.one_in(2) ? 0x1p1000 : 0x1p-1060;
    for (auto& p : query.start)
      for (double& c : p)
        c *= factor;
    for (double& c : query.end)
      c *= factor;
  }
  if (random.one_in(4)) {
    const double towards = random.sign() * INFINITY;
    const int point = random.integer(0, 3), coordinate = random.integer(0, 2);
    double& c = random.one_in(2) ? query.end[point] : query.start[point][coordinate];
    if (const double next = std::nextafter(c, towards); std::isfinite(next))
      c = next;
  }
  return query;
}

} // namespace

BOOST_AUTO_TEST_CASE(axis_sweeps_agree_with_the_oracle) {
  const std::uint64_t queries = count_from_environment("HAPTIC_SCULPT_AXIS_QUERIES", 30000),
                      seed = seed_from_environment(1);
  std::mt19937_64 engine(seed);
  Filter_counters counters;
  const Axis_traits traits(&counters);
  std::uint64_t wrong = 0, hits = 0, later = 0, degenerate = 0;
  for (std::uint64_t i = 0; i < queries; ++i) {
    const Axis_query query = any_query(engine);
    const bool expected = axis_features_meet(query);
    hits += expected;
    later += expected && !axis_features_meet_at(query, 0);
    if (answer(traits, query) != expected && ++wrong <= 10)
      BOOST_TEST_MESSAGE("WRONG, oracle says " << expected << ": " << line_of(query));
    const bool flat = axis_face_degenerates(query);
    degenerate += flat;
    if (face_answer(traits, query) != flat && ++wrong <= 10)
      BOOST_TEST_MESSAGE("WRONG, oracle says of the face " << flat << ": " << line_of(query));
  }
  BOOST_TEST_MESSAGE(queries << " queries, " << hits << " meet, " << later << " not at the start, " << degenerate
                             << " faces degenerate, " << wrong << " wrong; " << counters.failures()
                             << " signs past the filter, " << counters.big_integer << " by big integers");
  BOOST_TEST(wrong == 0u);
  if (queries >= 1000) {
    BOOST_TEST(hits > queries / 10);
    BOOST_TEST(later > queries / 50);
    BOOST_TEST(degenerate > queries / 20);
    BOOST_TEST(counters.failures() > 0u);
  }
}

// The answer does not depend on which axis is which, on who comes first, nor on the direction of time.
BOOST_AUTO_TEST_CASE(axis_sweeps_have_the_symmetries_of_the_question) {
  std::mt19937_64 engine(seed_from_environment(7));
  const Axis_traits traits;
  std::uint64_t wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    const Axis_query query = any_query(engine);
    const bool expected = answer(traits, query);
    Axis_query turned = query, back = query, other = query;
    turned.axis = (query.axis + 1) % 3;
    for (int p = 0; p < 4; ++p) {
      for (int k = 0; k < 3; ++k)
        turned.start[p][(k + 1) % 3] = query.start[p][k];
      std::swap(back.start[p][query.axis], back.end[p]);
    }
    const int first = query.is_vertex_and_face ? 1 : 0, second = query.is_vertex_and_face ? 3 : 1;
    std::swap(other.start[first], other.start[second]);
    std::swap(other.end[first], other.end[second]);
    wrong += answer(traits, turned) != expected;
    wrong += answer(traits, back) != expected;
    wrong += answer(traits, other) != expected;
  }
  BOOST_TEST(wrong == 0u);
}

BOOST_AUTO_TEST_CASE(axis_sweeps_agree_in_directed_rounding) {
  const Axis_traits traits;
  std::mt19937_64 engine(seed_from_environment(13));
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::uint64_t wrong = 0;
    for (int i = 0; i < 20000; ++i) {
      const Axis_query query = any_query(engine);
      const bool expected = answer(traits, query);
      const int before = std::fegetround();
      std::fesetround(mode);
      const bool found = answer(traits, query);
      std::fesetround(before);
      wrong += found != expected;
    }
    BOOST_TEST(wrong == 0u, "rounding mode " << mode);
  }
}

BOOST_AUTO_TEST_CASE(axis_sweeps_of_subnormal_numbers_agree_where_the_caller_flushes_them) {
  const Axis_traits traits;
  using P = Kernel::Point_3;
  constexpr double s = 1e-310;
  const P a(0, 0, 0), b(4 * s, 0, 0), c(0, 4 * s, 0);
  for (const bool flushes : {false, true}) {
    bool through = false, beside = true, edges = true, face = true;
    {
      const Callers_mode mode(FE_TONEAREST, flushes);
      through = traits.vertex_face_axis_sweep_3_object()(2, P(s, s, s), a, b, c, {-s, 0, 0, 0});
      beside = traits.vertex_face_axis_sweep_3_object()(2, P(3 * s, 3 * s, s), a, b, c, {-s, 0, 0, 0});
      edges = traits.edge_edge_axis_sweep_3_object()(2, P(-s, 0, s), P(s, 0, s), P(0, -s, 0), P(0, s, 0),
                                                     {-s, 3 * s, 0, 0});
      face = traits.degenerate_face_axis_sweep_3_object()(2, a, b, c, {9 * s, -9 * s, s});
      BOOST_TEST(mode.stands());
    }
    BOOST_TEST((through && !beside && !edges && !face));
  }
}

BOOST_AUTO_TEST_CASE(axis_sweeps_of_a_few_known_motions) {
  const Axis_traits traits;
  const auto vertex_and_face = traits.vertex_face_axis_sweep_3_object();
  using P = Kernel::Point_3;
  const P a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  BOOST_TEST(vertex_and_face(2, P(1, 1, 1), a, b, c, {-1, 0, 0, 0}));   // through
  BOOST_TEST(vertex_and_face(2, P(1, 1, 1), a, b, c, {0, 0, 0, 0}));    // onto
  BOOST_TEST(!vertex_and_face(2, P(1, 1, 1), a, b, c, {0x1p-1074, 0, 0, 0}));
  BOOST_TEST(!vertex_and_face(2, P(3, 3, 1), a, b, c, {-1, 0, 0, 0}));  // beside
  BOOST_TEST(vertex_and_face(2, P(2, 2, 1), a, b, c, {-1, 0, 0, 0}));   // over its edge
  BOOST_TEST(!vertex_and_face(2, P(1, 1, 1), a, b, c, {9, 8, 8, 8}));   // all of it
  BOOST_TEST(vertex_and_face(0, P(-1, 0, 0), a, P(0, 4, 0), P(0, 0, 4), {0, 0, 0, 0}));
  const auto edges = traits.edge_edge_axis_sweep_3_object();
  BOOST_TEST(edges(2, P(-1, 0, 1), P(1, 0, 1), P(0, -1, 0), P(0, 1, 0), {-1, -1, 0, 0}));
  BOOST_TEST(!edges(2, P(-1, 0, 1), P(1, 0, 1), P(0, -1, 0), P(0, 1, 0), {-1, 3, 0, 0})); // its middle stays above
  BOOST_TEST(edges(2, P(-1, 0, 1), P(1, 0, 1), P(0, 0, 0), P(2, 0, 0), {3, -1, 0, 0}));   // in a vertical plane
  BOOST_TEST(edges(2, P(0, 0, 0), P(0, 0, 1), P(0, 0, 2), P(0, 0, 3), {0, 2, 2, 3}));     // on a vertical line
  BOOST_TEST(!edges(2, P(0, 0, 0), P(0, 0, 1), P(0, 0, 2), P(0, 0, 3), {0, 2, 2.5, 3}));
  const auto face = traits.degenerate_face_axis_sweep_3_object();
  BOOST_TEST(!face(2, a, b, c, {9, -9, 1}));
  BOOST_TEST(face(2, P(0, 0, 0), P(2, 0, 0), P(1, 0, 1), {0, 0, -1}));
  BOOST_TEST(!face(2, P(0, 0, 0), P(2, 0, 0), P(1, 0, 1), {0, 0, 0x1p-1074}));
  BOOST_TEST(face(2, a, b, b, {1, 2, 3}));
}
