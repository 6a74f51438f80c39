// SPDX-License-Identifier: GPL-3.0-or-later
// Time against error of the axis sweeps, for several arithmetics, judged by linear feasibility in rational numbers.
#include "Benchmark_program.h"
#include "Mpfr_number.h"
#include "Query_timer.h"
#include "determinant_sweep.h"
#include "oracle/axis_oracle.h"

#include <haptic_sculpt/collision/Axis_sweep_traits_3.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cstdio>
#include <functional>
#include <iostream>
#include <random>

namespace {

using namespace haptic_sculpt;
using namespace haptic_sculpt::benchmark;
using test::Axis_query;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Json = nlohmann::ordered_json;
using Random = std::mt19937_64;

constexpr int ours_was_wrong = 10;

double uniform(Random& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// The test as one writes it down: signs of determinants at both ends, in one number type. \pre seen along the axis,
/// the face is not a segment and the edges are not parallel
template <class Number>
class Axis_determinants {
public:
  explicit Axis_determinants(const Axis_query& query) {
    for (int i = 0; i < 4; ++i) {
      x_[i] = Number(query.start[i][(query.axis + 1) % 3]), y_[i] = Number(query.start[i][(query.axis + 2) % 3]);
      start_[i] = Number(query.start[i][query.axis]), end_[i] = Number(query.end[i]);
    }
  }
  bool vertex_and_face() const {
    const int side = beside(1, 2, 3);
    return beside(1, 2, 0) * side >= 0 && beside(2, 3, 0) * side >= 0 && beside(3, 1, 0) * side >= 0 && changes();
  }
  bool edges() const {
    return beside(0, 1, 2) * beside(0, 1, 3) <= 0 && beside(2, 3, 0) * beside(2, 3, 1) <= 0 && changes();
  }

private:
  std::array<Number, 4> x_, y_, start_, end_;

  int beside(int a, int b, int c) const {
    return sign_of(Number((x_[b] - x_[a]) * (y_[c] - y_[a]) - (x_[c] - x_[a]) * (y_[b] - y_[a])));
  }
  int above(const std::array<Number, 4>& z) const {
    const auto minor = [&](int b, int c) {
      return Number((x_[b] - x_[0]) * (y_[c] - y_[0]) - (x_[c] - x_[0]) * (y_[b] - y_[0]));
    };
    return sign_of(Number((z[1] - z[0]) * minor(2, 3) - (z[2] - z[0]) * minor(1, 3) + (z[3] - z[0]) * minor(1, 2)));
  }
  bool changes() const { return above(start_) * above(end_) <= 0; }
};

template <class Number>
bool by_determinants(const Axis_query& query) {
  const Axis_determinants<Number> sweep(query);
  return query.is_vertex_and_face ? sweep.vertex_and_face() : sweep.edges();
}

bool by_ours(const Axis_query& query) {
  static const Axis_sweep_traits_3<Kernel> traits;
  const auto p = [&query](int i) { return Kernel::Point_3(query.start[i][0], query.start[i][1], query.start[i][2]); };
  return query.is_vertex_and_face
             ? traits.vertex_face_axis_sweep_3_object()(query.axis, p(0), p(1), p(2), p(3), query.end)
             : traits.edge_edge_axis_sweep_3_object()(query.axis, p(0), p(1), p(2), p(3), query.end);
}

/// Whether the plain test covers it.
bool is_ordinary_seen_along_the_axis(const Axis_query& q) {
  const int i = (q.axis + 1) % 3, j = (q.axis + 2) % 3;
  const auto d = [&](int a, int b, int k) { return mpq_class(mpq_class(q.start[b][k]) - mpq_class(q.start[a][k])); };
  const int a = q.is_vertex_and_face ? 1 : 0, b = a + 1, c = q.is_vertex_and_face ? 1 : 2, e = 3;
  return d(a, b, i) * d(c, e, j) != d(a, b, j) * d(c, e, i);
}

Axis_query anywhere(Random& random) {
  Axis_query q{};
  q.is_vertex_and_face = random() % 2 == 0, q.axis = static_cast<int>(random() % 3);
  for (auto& p : q.start)
    for (double& c : p)
      c = 2 * uniform(random) - 1;
  for (double& c : q.end)
    c = 2 * uniform(random) - 1;
  return q;
}

/// The first point is over the features' common place, or on an edge of it, and ends beside the height of the others.
Axis_query touching(Random& random, bool on_an_edge, double offset) {
  Axis_query q = anywhere(random);
  const int k = q.axis, i = (k + 1) % 3, j = (k + 2) % 3;
  double a = uniform(random), b = uniform(random);
  if (a + b > 1)
    a = 1 - a, b = 1 - b;
  if (on_an_edge)
    b = 0;
  if (q.is_vertex_and_face) {
    const auto mix = [&](double u, double v, double w) { return (1 - a - b) * u + a * v + b * w; };
    q.start[0][i] = mix(q.start[1][i], q.start[2][i], q.start[3][i]);
    q.start[0][j] = mix(q.start[1][j], q.start[2][j], q.start[3][j]);
    q.start[0][k] = 3;
    q.end[0] = mix(q.end[1], q.end[2], q.end[3]);
  } else { // the second edge begins at a place of the first and goes on as it was
    for (const int c : {i, j})
      q.start[2][c] = q.start[0][c] + a * (q.start[1][c] - q.start[0][c]);
    q.start[2][k] = q.start[3][k] = 3;
    q.end[2] = q.end[0] + a * (q.end[1] - q.end[0]);
    if (!on_an_edge) // ... or before it
      for (const int c : {i, j})
        q.start[2][c] -= q.start[3][c] - q.start[2][c];
    q.end[3] = q.end[2];
  }
  for (auto& p : q.start)
    for (double& c : p)
      c += offset;
  for (double& c : q.end)
    c += offset;
  return q;
}

Axis_query grid(Random& random) {
  Axis_query q = anywhere(random);
  for (auto& p : q.start)
    for (double& c : p)
      c = static_cast<double>(random() % 5) * 0.1;
  for (double& c : q.end)
    c = static_cast<double>(random() % 5) * 0.1;
  return q;
}

struct Population {
  const char* name;
  bool is_degenerate;
  std::function<Axis_query(Random&)> draw;
};

const std::vector<Population>& populations() {
  static const std::vector<Population> all = {
    {"anywhere", false, anywhere},
    {"ends in contact", true, [](Random& r) { return touching(r, false, 0); }},
    {"over an edge", true, [](Random& r) { return touching(r, true, 0); }},
    {"in contact, far off", true, [](Random& r) { return touching(r, r() % 2 == 0, 1e6); }},
    {"on a grid of tenths", true, grid}};
  return all;
}

struct Judged {
  Axis_query query;
  bool meets;
};

Json measure(const Query_timer& timer, const std::vector<Judged>& queries, const char* name,
             bool (*ask)(const Axis_query&)) {
  std::size_t false_positives = 0, false_negatives = 0;
  for (const Judged& q : queries) { // warms up, too
    const bool meets = ask(q.query);
    false_positives += meets && !q.meets, false_negatives += !meets && q.meets;
  }
  volatile std::size_t hits = 0; // or the loop could be left out
  const std::uint64_t begin = Query_timer::now();
  for (const Judged& q : queries)
    hits = hits + static_cast<std::size_t>(ask(q.query));
  const double mean = timer.nanoseconds(begin, Query_timer::now()) / static_cast<double>(queries.size());
  std::printf("  %-16s %9.0f ns, %zu false alarms, %zu misses\n", name, mean, false_positives, false_negatives);
  return {
      {"name", name}, {"mean_ns", mean}, {"false_positives", false_positives}, {"false_negatives", false_negatives}};
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Time of the axis sweeps against their error, for each arithmetic, judged by linear feasibility in rational "
      "numbers. Exit: 10 the exact ones were wrong.");
  std::uint64_t seed = 1;
  std::size_t count = 5000;
  app.add_option("--seed", seed, "Seed of the populations")->capture_default_str();
  app.add_option("--queries", count, "Queries of each population")->capture_default_str()->check(positive_number);
  Benchmark_program program("axis_speed_error", app, "population");
  return program.run(argc, argv, [&](Promises& promises) -> Json {
    const Query_timer timer;
    Json rows = Json::array();
    std::size_t asked = 0, wrong = 0;
    for (const Population& population : populations()) {
      const std::size_t unit = program.shard.next_unit();
      if (!program.shard.takes_next())
        continue;
      Random random(seed * 1000003 + unit);
      std::vector<Judged> queries;
      while (queries.size() < count)
        if (const Axis_query q = population.draw(random); is_ordinary_seen_along_the_axis(q))
          queries.push_back({q, test::axis_features_meet(q)});
      std::printf("%s\n", population.name);
      Json arithmetics = Json::array();
      arithmetics.push_back(measure(timer, queries, "double", by_determinants<double>));
      arithmetics.push_back(measure(timer, queries, "long double", by_determinants<long double>));
      arithmetics.push_back(measure(timer, queries, "MPFR 113 bits", by_determinants<Mpfr_number<113>>));
      arithmetics.push_back(measure(timer, queries, "GMP rationals", by_determinants<mpq_class>));
      arithmetics.push_back(measure(timer, queries, "haptic_sculpt", by_ours));
      const Json& ours = arithmetics.back();
      asked += count, wrong += ours["false_positives"].get<std::size_t>() + ours["false_negatives"].get<std::size_t>();
      rows.push_back({{"unit", unit},
                      {"name", population.name},
                      {"degenerate", population.is_degenerate},
                      {"arithmetics", arithmetics}});
    }
    promises.add(ours_was_wrong, "every axis sweep agrees with linear feasibility", asked, wrong);
    return {{"seed", seed}, {"queries_per_population", count}, {"populations", rows}};
  });
}
