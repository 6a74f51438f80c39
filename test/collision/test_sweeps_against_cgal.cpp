// SPDX-License-Identifier: GPL-3.0-or-later
// The verdicts of the sweeps against those put together from CGAL's own predicates: exact, too, and a hundred times as
// fast as the rational oracle. HAPTIC_SCULPT_CGAL_QUERIES sets how many are asked, HAPTIC_SCULPT_SEED which.
#include "collision/Sweeps_under_test.h"
#include "oracle/cgal_sweep.h"
#include "oracle/hexadecimal.h"
#include "seeds_and_sizes.h"

#include <boost/test/unit_test.hpp>

#include <random>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

BOOST_AUTO_TEST_CASE(sweeps_agree_with_predicates_of_cgal) {
  const std::uint64_t queries = count_from_environment("HAPTIC_SCULPT_CGAL_QUERIES", 300000);
  std::mt19937_64 engine(seed_from_environment(1));
  const Traits traits;
  const Cgal_sweep other;
  const std::uint64_t each = queries / sweep_populations().size() + 1;
  std::uint64_t asked = 0, hits = 0, wrong = 0;
  for (const Sweep_population& population : sweep_populations())
    for (std::uint64_t i = 0; i < each; ++i) {
      const Sweep_query query = population(sweep_kinds[i % 3], engine);
      const bool expected =
          other(query.kind, {point(query, 0), point(query, 1), point(query, 2), point(query, 3), point(query, 4)});
      ++asked, hits += expected;
      if (do_collide(traits, query) != expected && ++wrong <= 10)
        BOOST_TEST_MESSAGE("WRONG: CGAL says " << expected << ": " << hexadecimal(query.kind, query.x));
    }
  BOOST_TEST_MESSAGE(asked << " queries, " << hits << " hits, " << wrong << " wrong");
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(hits > asked / 4);
}
