// SPDX-License-Identifier: GPL-3.0-or-later
// Motions far from all that is at rest, as drags to far targets make them: against linear feasibility over the
// integers, and without integers in nearly all sweeps.
#include "collision/Sweeps_under_test.h"
#include "oracle/hexadecimal.h"

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <cfenv>
#include <cmath>
#include <random>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Vector = std::array<double, 3>;
using Counting_traits = Swept_collision_traits_3<Kernel, Filter_counters>;

Vector random_vector(std::mt19937_64& engine) {
  std::uniform_real_distribution<double> number(-1, 1);
  return {number(engine), number(engine), number(engine)};
}

Vector sum(const Vector& a, double factor, const Vector& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

/// J goes from S to T, 2^10 to 2^60 from a scene of size 1, by all of that or down to 2^-45 of it; what is at rest is
/// where its edges or faces pass, to within 2^-3 to 2^-62.
Sweep_query far_motion(Sweep_kind kind, std::mt19937_64& engine) {
  std::uniform_real_distribution<double> part(0, 1);
  const double far = std::ldexp(1., 10 + static_cast<int>(engine() % 51)),
               step = std::ldexp(far, -static_cast<int>(engine() % 46));
  const Vector direction = random_vector(engine);
  std::array<Vector, 5> p;
  p[0] = sum({}, far, direction);
  p[1] = sum(p[0], step, random_vector(engine));
  const Vector half = sum(p[0], 0.5, sum(p[1], -1, p[0]));
  for (int i = 2; i < 5; ++i)
    p[static_cast<std::size_t>(i)] = random_vector(engine);
  const Vector along = sum({}, part(engine) / far, half), beside = random_vector(engine);
  const double near = std::ldexp(0x1p-3, -static_cast<int>(engine() % 60));
  if (kind == Sweep_kind::edge_edge) { // V A B
    const Vector x = sum(p[2], 1, along);
    p[3] = sum(x, 1, beside), p[4] = sum(sum(x, -part(engine), beside), near, random_vector(engine));
  } else if (kind == Sweep_kind::face_vertex) // G I A
    p[4] = sum(sum(sum(p[2], 0.5, sum(p[3], -1, p[2])), 1, along), near, beside);
  Sweep_query query{kind, {}};
  for (std::size_t i = 0; i < 15; ++i)
    query.x[i] = p[i / 3][i % 3];
  return query;
}

std::optional<Kernel::FT> asked(const Counting_traits& traits, const Sweep_query& query) {
  const auto p = [&query](int i) { return point(query, i); };
  const auto time = [](const auto& impact) {
    return impact ? std::optional<Kernel::FT>(impact->time().first) : std::nullopt;
  };
  if (query.kind == Sweep_kind::edge_edge)
    return time(traits.edge_edge_sweep_3_object()(p(0), p(1), p(2), p(3), p(4)));
  return time(traits.face_vertex_sweep_3_object()(p(0), p(1), p(2), p(3), p(4)));
}

} // namespace

BOOST_AUTO_TEST_CASE(far_motions_agree_with_the_oracle_without_integers) {
  constexpr int queries = 6000;
  std::mt19937_64 engine(seed_from_environment(71));
  const int before = std::fegetround();
  for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
    for (const Sweep_kind kind : {Sweep_kind::edge_edge, Sweep_kind::face_vertex}) {
      Filter_counters counters;
      const Counting_traits traits(&counters);
      int hits = 0, wrong = 0;
      for (int i = 0; i < queries / 4; ++i) {
        const Sweep_query query = far_motion(kind, engine);
        if (!standing_features_are_simplices(kind, query.x))
          continue;
        std::fesetround(mode);
        const std::optional<double> time = asked(traits, query);
        std::fesetround(before);
        const bool expected = first_meeting(kind, query.x).has_value();
        hits += expected;
        if (time.has_value() != expected && ++wrong <= 10)
          BOOST_TEST_MESSAGE("WRONG " << hexadecimal(kind, query.x));
      }
      const std::uint64_t in_integers = counters.failures() - counters.permanent;
      BOOST_TEST_MESSAGE(sweep_name(kind) << ": " << hits << " hits, " << counters.permanent
                                          << " signs by the permanent, " << in_integers << " by integers");
      BOOST_TEST(wrong == 0);
      BOOST_TEST(hits > queries / 40);
      BOOST_TEST(counters.permanent > static_cast<std::uint64_t>(queries / 40));
      BOOST_TEST(in_integers < static_cast<std::uint64_t>(queries / 40)); // a tenth
    }
}
