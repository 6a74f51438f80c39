// SPDX-License-Identifier: GPL-3.0-or-later
// The populations themselves: the same everywhere, valid, and rich in hits, misses and touches.
#include "oracle/sweep_oracle.h"
#include "populations/sweep_populations.h"

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>

using namespace haptic_sculpt::test;

namespace {

/// How the two hulls meet. A crossing has one solution with all five weights positive: it survives any small change. A
/// touch has a vertex with a vanishing weight, or many solutions.
enum class Meeting { none, touch, crossing };

Meeting meeting(const Sweep_query& query) {
  Meeting result = Meeting::none;
  visit_meeting_weights(query.kind, query.x, [&result](const std::array<mpz_class, 5>& weight, const mpz_class&) {
    bool inside = true;
    for (const mpz_class& w : weight)
      inside = inside && sgn(w) > 0;
    result = inside ? Meeting::crossing : Meeting::touch;
  });
  return result;
}

} // namespace

// A changed sum means changed queries: every figure published for these populations would have to be taken again.
BOOST_AUTO_TEST_CASE(are_the_same_everywhere) {
  std::uint64_t hash = 14695981039346656037u; // FNV-1a
  std::mt19937_64 engine(1);                  // the sum is of this seed
  for (const Sweep_population& population : sweep_populations())
    for (int i = 0; i < 200; ++i)
      for (double c : population(engine).x) {
        std::uint64_t bits;
        std::memcpy(&bits, &c, sizeof bits);
        hash = (hash ^ bits) * 1099511628211u;
      }
  BOOST_TEST(hash == 3384863123586436235u);
}

BOOST_AUTO_TEST_CASE(have_hits_misses_and_touches) {
  const int queries = 1000;
  std::mt19937_64 engine(seed_from_environment(3));
  BOOST_TEST_MESSAGE("of " << queries << " queries each, per cent: crossing, touch, miss, u = 0, u = 1");
  for (const Sweep_population& population : sweep_populations())
    for (Sweep_kind kind : sweep_kinds) {
      int crossings = 0, touches = 0, at_start = 0, at_end = 0;
      for (int i = 0; i < queries; ++i) {
        const Sweep_query query = population(kind, engine);
        BOOST_REQUIRE(standing_features_are_simplices(kind, query.x));
        BOOST_REQUIRE(std::all_of(query.x.begin(), query.x.end(), [](double c) { return std::isfinite(c); }));
        const Meeting how = meeting(query);
        crossings += how == Meeting::crossing;
        touches += how == Meeting::touch;
        if (const std::optional<mpq_class> u = first_time(kind, query.x)) {
          at_start += *u == 0;
          at_end += *u == 1;
        }
      }
      const int misses = queries - crossings - touches;
      char line[100];
      std::snprintf(line, sizeof line, "%-24s %s %5.1f %5.1f %5.1f %5.1f %5.1f", population.name.c_str(),
                    sweep_name(kind), crossings * 100. / queries, touches * 100. / queries, misses * 100. / queries,
                    at_start * 100. / queries, at_end * 100. / queries);
      BOOST_TEST_MESSAGE(line);
      BOOST_TEST(crossings + touches >= queries / 50, line);
      BOOST_TEST(misses >= queries / 20, line);
      if (population.degenerate)
        BOOST_TEST(touches >= queries / 50, line);
    }
}
