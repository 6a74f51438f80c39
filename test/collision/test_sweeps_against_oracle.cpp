// SPDX-License-Identifier: GPL-3.0-or-later
// The sweeps against linear feasibility over the integers, on every population: verdict, time, order of times.
// HAPTIC_SCULPT_SWEEP_QUERIES sets how many queries are asked, HAPTIC_SCULPT_SEED which; see doc/use/testing.md.
#include "collision/Sweeps_under_test.h"
#include "oracle/hexadecimal.h"
#include "oracle/sample_queries.h"

#include <seeds_and_sizes.h>
#include <shared_data.h>

#include <boost/test/unit_test.hpp>
#include <algorithm>
#include <cfenv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

struct Timed_impact {
  Sweep_query query;
  Impact impact;
  mpq_class time; ///< the oracle's
};

/// What went wrong, and how often; the first few faults of each kind are shown in full.
struct Tally {
  std::uint64_t queries = 0, hits = 0, comparisons = 0, close_pairs = 0, equal_pairs = 0;
  std::uint64_t wrong_verdicts = 0, wrong_times = 0, wrong_enclosures = 0, wrong_locations = 0, wrong_orders = 0;

  std::uint64_t faults() const {
    return wrong_verdicts + wrong_times + wrong_enclosures + wrong_locations + wrong_orders;
  }
  void add(const Tally& other) {
    queries += other.queries, hits += other.hits, comparisons += other.comparisons;
    close_pairs += other.close_pairs, equal_pairs += other.equal_pairs;
    wrong_verdicts += other.wrong_verdicts, wrong_times += other.wrong_times;
    wrong_enclosures += other.wrong_enclosures, wrong_locations += other.wrong_locations;
    wrong_orders += other.wrong_orders;
  }
};

template <Impact_feature feature, class Counters, class Mode>
auto without_guard(const Sweep_3<feature, Kernel, Counters, Mode>& sweep) {
  return Sweep_3<feature, Kernel, Counters, internal::Mode_is_set>(sweep);
}

void show(const std::string& what, std::uint64_t number) {
  if (number <= 10)
    BOOST_TEST_MESSAGE("WRONG " << what);
}

/// Asks one query and checks all of the answer; returns the impact if there is one.
std::optional<Timed_impact> check(const Traits& traits, const Sweep_query& query, Tally& tally) {
  const std::optional<First_meeting> expected = first_meeting(query.kind, query.x);
  const std::optional<Impact> impact = sweep(traits, query);
  ++tally.queries;
  if (impact.has_value() != expected.has_value() || do_collide(traits, query) != expected.has_value()) {
    show("verdict, oracle says " + std::to_string(expected.has_value()) + ": " + hexadecimal(query.kind, query.x),
         ++tally.wrong_verdicts);
    return std::nullopt;
  }
  if (!impact)
    return std::nullopt;
  ++tally.hits;
  const mpq_class& u = expected->time;
  if (mpq_class(impact->exact_time()) != u)
    show("time " + mpq_class(impact->exact_time()).get_str() + ", oracle says " + u.get_str() + ": " +
           hexadecimal(query.kind, query.x), ++tally.wrong_times);
  if (impact->is_at_start() != (u == 0))
    show("whether it is at the start, oracle says " + u.get_str() + ": " + hexadecimal(query.kind, query.x),
         ++tally.wrong_times);
  const std::pair<double, double> enclosure = impact->time();
  // an enclosure that is not much tighter than [0, 1] would be right and useless
  if (!(enclosure.first <= u && u <= enclosure.second && enclosure.second - enclosure.first <= 0x1p-40))
    show("enclosure [" + std::to_string(enclosure.first) + ", " + std::to_string(enclosure.second) + "] of " +
           u.get_str() + ": " + hexadecimal(query.kind, query.x), ++tally.wrong_enclosures);
  if (impact->feature() != feature(query.kind) ||
      (query.kind == Sweep_kind::vertex_face && impact->location() != location(*expected)))
    show("location: " + hexadecimal(query.kind, query.x), ++tally.wrong_locations);
  return Timed_impact{query, *impact, u};
}

void check_order(const Traits& traits, const Timed_impact& a, const Timed_impact& b, Tally& tally) {
  const auto compare_time = traits.compare_time_3_object();
  const int expected = sgn(mpq_class(a.time - b.time));
  ++tally.comparisons;
  if (expected == 0)
    ++tally.equal_pairs;
  else if (abs(mpq_class(a.time - b.time)) * 0x1p53 < std::max(a.time, b.time))
    ++tally.close_pairs; // nearer than the last bit of the greater time
  if (static_cast<int>(compare_time(a.impact, b.impact)) != expected ||
      static_cast<int>(compare_time(b.impact, a.impact)) != -expected)
    show("order, oracle says " + std::to_string(expected) + ": " + hexadecimal(a.query.kind, a.query.x) + " and " +
           hexadecimal(b.query.kind, b.query.x), ++tally.wrong_orders);
}

/// The query with one coordinate moved by one ulp, if that leaves the standing features simplices.
std::optional<Sweep_query> nudged(Sweep_query query, std::mt19937_64& engine) {
  double& c = query.x[engine() % 15];
  c = std::nextafter(c, engine() % 2 == 0 ? INFINITY : -INFINITY);
  if (!std::isfinite(c) || !standing_features_are_simplices(query.kind, query.x))
    return std::nullopt;
  return query;
}

/// The impacts seen last, of all kinds and populations, to compare new ones with.
class Recent_impacts {
public:
  void compare_and_keep(const Traits& traits, const Timed_impact& impact, std::mt19937_64& engine, Tally& tally) {
    check_order(traits, impact, impact, tally);
    for (int i = 0; i < 2 && !m_impacts.empty(); ++i)
      check_order(traits, impact, m_impacts[engine() % m_impacts.size()], tally);
    if (m_impacts.size() < 256)
      m_impacts.push_back(impact);
    else
      m_impacts[engine() % m_impacts.size()] = impact;
  }

private:
  std::vector<Timed_impact> m_impacts;
};

void ask_all_populations(std::uint64_t queries, std::uint64_t seed, Tally& total) {
  const Traits traits;
  std::mt19937_64 engine(seed);
  Recent_impacts recent;
  const std::uint64_t each = queries / (3 * sweep_populations().size()) + 1;
  for (const Sweep_population& population : sweep_populations()) {
    Tally tally;
    for (std::uint64_t i = 0; i < 3 * each; ++i) {
      const std::optional<Timed_impact> impact = check(traits, population(sweep_kinds[i % 3], engine), tally);
      if (!impact)
        continue;
      recent.compare_and_keep(traits, *impact, engine, tally);
      if (engine() % 4 != 0)
        continue;
      if (const std::optional<Sweep_query> neighbour = nudged(impact->query, engine))
        if (const std::optional<Timed_impact> other = check(traits, *neighbour, tally))
          check_order(traits, *impact, *other, tally);
    }
    char line[160];
    std::snprintf(line, sizeof line, "%-24s %9llu queries %9llu hits; wrong: %llu verdicts %llu times %llu enclosures "
                  "%llu locations %llu orders", population.name.c_str(), (unsigned long long)tally.queries,
                  (unsigned long long)tally.hits, (unsigned long long)tally.wrong_verdicts,
                  (unsigned long long)tally.wrong_times, (unsigned long long)tally.wrong_enclosures,
                  (unsigned long long)tally.wrong_locations, (unsigned long long)tally.wrong_orders);
    BOOST_TEST_MESSAGE(line);
    BOOST_TEST(tally.faults() == 0u, population.name);
    total.add(tally);
  }
  BOOST_TEST_MESSAGE(total.queries << " queries, " << total.hits << " hits, " << total.comparisons
                                   << " pairs of times, of them " << total.equal_pairs << " equal and "
                                   << total.close_pairs << " less than an ulp apart; " << total.faults() << " faults");
}

} // namespace

BOOST_AUTO_TEST_CASE(sweeps_agree_with_the_oracle) {
  const std::uint64_t queries =
      count_from_environment("HAPTIC_SCULPT_SWEEP_QUERIES", HAPTIC_SCULPT_DEFAULT_SWEEP_QUERIES);
  const std::uint64_t seed = seed_from_environment(1);
  Tally total;
  ask_all_populations(queries, seed, total);
  BOOST_TEST(total.queries >= queries);
  if (queries >= 10000) {
    BOOST_TEST(total.hits > total.queries / 4);
    BOOST_TEST(total.equal_pairs > total.queries / 20);
    BOOST_TEST(total.close_pairs > total.queries / 1000);
  }
}

// Meshes that are not embedded have edges of no length.
BOOST_AUTO_TEST_CASE(sweeps_agree_where_an_edge_is_a_point) {
  const Traits traits;
  std::mt19937_64 engine(seed_from_environment(12));
  Tally tally;
  for (const Sweep_population& population : sweep_populations())
    for (int i = 0; i < 1000; ++i) {
      Sweep_query query = population(engine);
      const int first = query.kind == Sweep_kind::edge_edge ? 3 : 2; // of the edge that does not move
      const int from = first + i % 2, to = first + 1 - i % 2;
      std::copy_n(&query.x[3 * from], 3, &query.x[3 * to]);
      const std::optional<First_meeting> expected = first_meeting(query.kind, query.x);
      const std::optional<Impact> impact = sweep(traits, query);
      ++tally.queries;
      tally.hits += impact.has_value();
      if (impact.has_value() != expected.has_value())
        show("verdict: " + hexadecimal(query.kind, query.x), ++tally.wrong_verdicts);
      else if (impact && !(impact->time().first <= expected->time && expected->time <= impact->time().second))
        show("enclosure: " + hexadecimal(query.kind, query.x), ++tally.wrong_enclosures);
    }
  BOOST_TEST_MESSAGE(tally.queries << " queries, " << tally.hits << " hits");
  BOOST_TEST(tally.faults() == 0u);
  BOOST_TEST(tally.hits > tally.queries / 50);
}

// The filters are to hold in every rounding mode, for whoever calls between CGAL's own interval computations.
BOOST_AUTO_TEST_CASE(sweeps_agree_in_directed_rounding) {
  const Traits traits;
  std::mt19937_64 engine(seed_from_environment(11));
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    Tally tally;
    for (const Sweep_population& population : sweep_populations())
      for (int i = 0; i < 1500; ++i) {
        const Sweep_query query = population(engine);
        const std::optional<First_meeting> expected = first_meeting(query.kind, query.x);
        const int before = std::fegetround();
        std::fesetround(mode);
        const std::optional<Impact> impact = sweep(traits, query);
        const std::optional<std::pair<double, double>> enclosure =
          impact ? std::optional<std::pair<double, double>>(impact->time()) : std::nullopt;
        // Without the guard that sets the mode: the bounds of the filters hold in every one.
        const bool collides = with_functor(traits, query, [](const auto& functor, const auto&... p) {
          return without_guard(functor).do_collide(p...);
        });
        std::fesetround(before);
        ++tally.queries;
        if (collides != expected.has_value())
          show("verdict without the guard, rounding mode " + std::to_string(mode) + ": " +
                   hexadecimal(query.kind, query.x),
               ++tally.wrong_verdicts);
        if (impact.has_value() != expected.has_value())
          show("verdict, rounding mode " + std::to_string(mode) + ": " + hexadecimal(query.kind, query.x),
               ++tally.wrong_verdicts);
        else if (impact && !(enclosure->first <= expected->time && expected->time <= enclosure->second))
          show("enclosure, rounding mode " + std::to_string(mode) + ": " + hexadecimal(query.kind, query.x),
               ++tally.wrong_enclosures);
      }
    BOOST_TEST(tally.faults() == 0u, "rounding mode " << mode);
  }
}

// J enters the plane of the parallelogram A C B D (D = A + B - C) inside ABC. At that very moment JD crosses the
// diagonal AB, and the triangle J D I, I = 2A - B, contains A: three impacts of three kinds at one time. Then one ulp
// away.
// Of a triangle without an area: where it is met at the start is where it is met from above.
BOOST_AUTO_TEST_CASE(places_on_a_flat_triangle_are_the_same_at_the_start_as_later) {
  using K = CGAL::Exact_predicates_inexact_constructions_kernel;
  using P = K::Point_3;
  const Vertex_face_sweep_3<K> sweep;
  const P a(0, 0, 0), b(1, 0, 0), c(2, 0, 0);
  const std::array<std::pair<double, Triangle_location>, 3> places = {{{0, Triangle_location::vertex_a},
                                                                       {0.5, Triangle_location::edge_ab},
                                                                       {2, Triangle_location::vertex_c}}};
  for (const auto& [x, place] : places)
    for (const double height : {0.0, 1.0}) {
      const auto impact = sweep(P(x, 0, height), P(x, 0, height - 2), a, b, c);
      BOOST_REQUIRE(impact.has_value());
      const bool is_there = impact->location() == place || (place == Triangle_location::edge_ab &&
                                                            impact->location() == Triangle_location::edge_ca);
      BOOST_TEST(is_there, "at " << x << ", from " << height << ": " << name_of(impact->location()));
    }
}

BOOST_AUTO_TEST_CASE(equal_times_of_different_kinds) {
  const Traits traits;
  std::mt19937_64 engine(seed_from_environment(5));
  Tally tally;
  int complete = 0;
  for (int i = 0; i < 3000; ++i) {
    Sweep_query face{Sweep_kind::vertex_face, {}};
    do // of a lattice fine enough to be generic, coarse enough for D and I to be exact
      for (double& c : face.x)
        c = static_cast<int>(engine() % 2001) - 1000;
    while (!standing_features_are_simplices(face.kind, face.x) || !first_time(face.kind, face.x));
    Sweep_query edge{Sweep_kind::edge_edge, face.x}, vertex{Sweep_kind::face_vertex, face.x};
    for (int axis = 0; axis < 3; ++axis) {
      const double a = face.x[6 + axis], b = face.x[9 + axis], c = face.x[12 + axis];
      edge.x[6 + axis] = vertex.x[6 + axis] = a + b - c;
      edge.x[9 + axis] = a;
      edge.x[12 + axis] = b;
      vertex.x[9 + axis] = 2 * a - b;
      vertex.x[12 + axis] = a;
    }
    std::vector<Timed_impact> impacts;
    for (const Sweep_query& query : {face, edge, vertex}) {
      if (const std::optional<Timed_impact> impact = check(traits, query, tally))
        impacts.push_back(*impact);
      if (const std::optional<Sweep_query> neighbour = nudged(query, engine))
        if (const std::optional<Timed_impact> impact = check(traits, *neighbour, tally))
          impacts.push_back(*impact);
    }
    const mpq_class time = impacts.at(0).time;
    complete +=
        std::count_if(impacts.begin(), impacts.end(), [&](const Timed_impact& t) { return t.time == time; }) >= 3;
    for (const Timed_impact& a : impacts)
      for (const Timed_impact& b : impacts)
        check_order(traits, a, b, tally);
  }
  BOOST_TEST_MESSAGE(tally.comparisons << " pairs, " << tally.equal_pairs << " equal, " << tally.close_pairs
                                       << " less than an ulp apart");
  BOOST_TEST(complete == 3000);
  BOOST_TEST(tally.close_pairs > 1000u);
  BOOST_TEST(tally.faults() == 0u);
}

BOOST_AUTO_TEST_CASE(published_queries) {
  const auto file = haptic_sculpt::test::shared_data("ccd/sample_queries.txt");
  if (!file)
    return;
  const Traits traits;
  std::mt19937_64 engine(seed_from_environment(2));
  Tally tally;
  Recent_impacts recent;
  int disagreements = 0;
  for (const Sample_query& sample : read_sample_queries(file->string())) {
    const Sweep_query query{sample.kind, sample.x};
    BOOST_REQUIRE(standing_features_are_simplices(query.kind, query.x));
    if (const std::optional<Timed_impact> impact = check(traits, query, tally))
      recent.compare_and_keep(traits, *impact, engine, tally);
    disagreements += do_collide(traits, query) != sample.truth;
  }
  BOOST_TEST_MESSAGE(tally.queries << " published queries, " << tally.hits << " hits, " << disagreements
                                   << " unlike the published truth");
  BOOST_TEST(tally.queries > 0u);
  BOOST_TEST(disagreements == 0);
  BOOST_TEST(tally.faults() == 0u);
}
