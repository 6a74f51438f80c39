// SPDX-License-Identifier: GPL-3.0-or-later
// Time against error of the sweeps, for many arithmetics and populations, judged by the rational oracle.
#include "Benchmark_program.h"
#include "Mpfr_number.h"
#include "Query_timer.h"
#include "determinant_sweep.h"
#include "oracle/cgal_sweep.h"
#include "oracle/sweep_oracle.h"
#include "paper_sweep.h"
#include "populations/sweep_populations.h"
#include "quantile.h"

#include <haptic_sculpt/collision.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <random>
#include <string>
#include <system_error>
#include <vector>

namespace haptic_sculpt::benchmark {

constexpr int ours_was_wrong = 10;

using test::Cgal_sweep;
using Kernel = Cgal_sweep::Kernel;
using Points = std::array<Kernel::Point_3, 5>;
using Lazy_number = CGAL::Exact_predicates_exact_constructions_kernel::FT;

/// A query with its points as each side wants them, and the truth.
struct Judged_query {
  test::Sweep_query query;
  Points points;
  std::optional<mpq_class> time;
};

/// What one way of answering took and got wrong on one population.
struct Result {
  std::string name;
  bool gives_time = true;
  bool is_ours = false; ///< promised to be right
  double mean = 0, median = 0, p99 = 0;
  std::uint64_t false_positives = 0, false_negatives = 0;
  double largest_error = 0;
};

/// A time outside [0, 1], or none, is as wrong as can be: 1.
double error_of(double time, const mpq_class& truth) {
  if (!(time >= 0 && time <= 1))
    return 1;
  return std::abs(mpq_class(mpq_class(time) - truth).get_d());
}

template <class Ask>
Result measure(const Query_timer& timer, const std::vector<Judged_query>& queries, const std::string& name,
               bool gives_time, bool is_ours, Ask ask) {
  Result result{name, gives_time, is_ours};
  std::uint64_t hits = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(queries.size(), 200); ++i) // warm up
    hits += ask(queries[i]).hits;
  const std::uint64_t begin = Query_timer::now();
  for (const Judged_query& query : queries)
    hits += ask(query).hits;
  const std::uint64_t end = Query_timer::now();
  result.mean = timer.nanoseconds(begin, end) / static_cast<double>(queries.size());
  std::vector<double> times;
  times.reserve(queries.size());
  for (const Judged_query& query : queries) {
    const std::uint64_t start = Query_timer::now();
    const Sweep_answer answer = ask(query);
    const std::uint64_t stop = Query_timer::now();
    times.push_back(timer.nanoseconds(start, stop));
    result.false_positives += answer.hits && !query.time;
    result.false_negatives += !answer.hits && query.time;
    if (gives_time && answer.hits && query.time)
      result.largest_error = std::max(result.largest_error, error_of(answer.time, *query.time));
  }
  volatile std::uint64_t used = hits; // or the untimed loop could be left out
  static_cast<void>(used);
  result.median = quantile(times, 0.5);
  result.p99 = quantile(times, 0.99);
  return result;
}

/// Calls one functor of ours with the five points.
template <class Traits, class Call>
auto with_functor(const Traits& traits, const Judged_query& q, Call call) {
  const Points& p = q.points;
  switch (q.query.kind) {
  case test::Sweep_kind::vertex_face: return call(traits.vertex_face_sweep_3_object(), p[0], p[1], p[2], p[3], p[4]);
  case test::Sweep_kind::edge_edge: return call(traits.edge_edge_sweep_3_object(), p[0], p[1], p[2], p[3], p[4]);
  default: return call(traits.face_vertex_sweep_3_object(), p[0], p[1], p[2], p[3], p[4]);
  }
}

template <class Number> Sweep_answer by_determinants(const Judged_query& q) {
  return determinant_sweep<Number>(q.query.kind, q.query.x);
}

std::vector<Result> measure_all(const Query_timer& timer, const std::vector<Judged_query>& queries) {
  const Swept_collision_traits_3<Kernel> traits;
  const Cgal_sweep cgal_sweep;
  std::vector<Result> results;
  const auto add = [&](const char* name, bool gives_time, auto ask) {
    results.push_back(measure(timer, queries, name, gives_time, false, ask));
  };
  const auto add_ours = [&](const char* name, bool gives_time, auto ask) {
    results.push_back(measure(timer, queries, name, gives_time, true, ask));
  };
  add("double", true, by_determinants<double>);
  add("paper, epsilon 1e-9", true, [](const Judged_query& q) { return Paper_sweep(q.query.kind, q.query.x)(); });
  add("long double", true, by_determinants<long double>);
  add("MPFR 53 bits", true, by_determinants<Mpfr_number<53>>);
  add("MPFR 64 bits", true, by_determinants<Mpfr_number<64>>);
  add("MPFR 113 bits", true, by_determinants<Mpfr_number<113>>);
  add("MPFR 256 bits", true, by_determinants<Mpfr_number<256>>);
  add("EPECK", true, by_determinants<Lazy_number>);
  add("GMP rationals", true, by_determinants<mpq_class>);
  add("EPICK composition, verdict", false, [&](const Judged_query& q) {
    return Sweep_answer{cgal_sweep(q.query.kind, q.points)};
  });
  add("EPICK composition, rational time", true, [&](const Judged_query& q) {
    return cgal_sweep(q.query.kind, q.points) ? by_determinants<mpq_class>(q) : Sweep_answer{};
  });
  add_ours("haptic_sculpt, verdict", false, [&](const Judged_query& q) {
    return Sweep_answer{with_functor(traits, q, [](const auto& f, const auto&... p) { return f.do_collide(p...); })};
  });
  add_ours("haptic_sculpt, verdict and enclosed time", true, [&](const Judged_query& q) {
    const std::optional<Impact_3<Kernel>> impact = with_functor(
        traits, q, [](const auto& f, const auto&... p) -> std::optional<Impact_3<Kernel>> { return f(p...); });
    if (!impact)
      return Sweep_answer{};
    const std::pair<double, double> time = impact->time();
    return Sweep_answer{true, time.first + (time.second - time.first) / 2};
  });
  add_ours("haptic_sculpt, verdict and rational time", true, [&](const Judged_query& q) {
    const std::optional<Impact_3<Kernel>> impact = with_functor(
        traits, q, [](const auto& f, const auto&... p) -> std::optional<Impact_3<Kernel>> { return f(p...); });
    return impact ? Sweep_answer{true, as_double(impact->exact_time())} : Sweep_answer{};
  });
  return results;
}

/// The share of queries of which some sign left each stage of our filter.
nlohmann::json filter_shares(const std::vector<Judged_query>& queries) {
  std::array<std::uint64_t, 5> reached{};
  for (const Judged_query& q : queries) {
    Filter_counters counters;
    const Swept_collision_traits_3<Kernel, Filter_counters> traits(&counters);
    with_functor(traits, q, [](const auto& f, const auto&... p) { return f.do_collide(p...); });
    reached[0] += counters.permanent != 0;
    reached[1] += counters.integer_64 != 0;
    reached[2] += counters.integer_128 != 0;
    reached[3] += counters.integer_256 != 0;
    reached[4] += counters.big_integer != 0;
  }
  const auto share = [&](std::size_t stage) {
    return static_cast<double>(reached[stage]) / static_cast<double>(queries.size());
  };
  return {{"permanent", share(0)},
          {"integer_64", share(1)},
          {"integer_128", share(2)},
          {"integer_256", share(3)},
          {"big_integer", share(4)}};
}

std::vector<Judged_query> judged_queries(const test::Sweep_population& population, std::size_t count,
                                         std::mt19937_64& engine) {
  std::vector<Judged_query> queries;
  queries.reserve(count);
  while (queries.size() < count) {
    const test::Sweep_query query = population(engine);
    const auto point = [&](int i) { return Kernel::Point_3(query.x[3 * i], query.x[3 * i + 1], query.x[3 * i + 2]); };
    queries.push_back(
        {query, {point(0), point(1), point(2), point(3), point(4)}, test::first_time(query.kind, query.x)});
  }
  return queries;
}

/// For other programs: a line for each query, and what the oracle says.
void write(const std::vector<Judged_query>& queries, std::ostream& asked, std::ostream& truth) {
  for (const Judged_query& q : queries) {
    asked << (q.query.kind == test::Sweep_kind::vertex_face ? "VF"
              : q.query.kind == test::Sweep_kind::edge_edge ? "EE"
                                                            : "FV")
          << std::hexfloat;
    for (const double x : q.query.x)
      asked << ' ' << x;
    asked << '\n';
    if (q.time)
      truth << "1 " << q.time->get_num() << '/' << q.time->get_den() << '\n';
    else
      truth << "0\n";
  }
}

nlohmann::json as_json(const Result& result) {
  nlohmann::json json{{"name", result.name},     {"mean_ns", result.mean},
                      {"median_ns", result.median}, {"p99_ns", result.p99},
                      {"false_positives", result.false_positives}, {"false_negatives", result.false_negatives}};
  json["largest_error_in_u"] = result.gives_time ? nlohmann::json(result.largest_error) : nlohmann::json();
  return json;
}

} // namespace haptic_sculpt::benchmark

int main(int argc, char** argv) {
  using namespace haptic_sculpt::benchmark;
  using haptic_sculpt::test::sweep_populations;
  CLI::App app{
      "Time of the sweeps against their error, for each arithmetic and population, judged by a rational oracle\n"
      "Exit: 10 haptic_sculpt gave a wrong verdict."};
  std::uint64_t seed = 1;
  std::size_t count = 5000;
  std::vector<std::string> chosen;
  std::string folder;
  app.add_option("--seed", seed, "Seed of the populations")->capture_default_str();
  app.add_option("--queries", count, "Queries of each population")->capture_default_str()->check(positive_number);
  std::vector<std::string> names;
  for (const auto& population : sweep_populations())
    names.push_back(population.name);
  app.add_option("--population", chosen, "Only these populations")->check(CLI::IsMember(names));
  app.add_option(
      "--write-queries", folder,
      "Folder that gets queries.txt, as sweep_queries reads them, and truth.txt, by the oracle; nothing is timed");
  Benchmark_program program("sweep_speed_error", app, "population");
  return program.run(argc, argv, [&](Promises& promises) {
    if (!folder.empty() && program.shard.text() != "0/1")
      throw haptic_sculpt::benchmark::Wrong_use(
          "--write-queries writes the queries of all populations: give it without --shard");
    std::ofstream asked, truth; // answers to those that are there stay answers, until both are whole
    if (!folder.empty()) {
      std::error_code error; // that none can be made is said below
      std::filesystem::create_directories(folder, error);
      asked.open(folder + "/queries.txt.unfinished"), truth.open(folder + "/truth.txt.unfinished");
      if (!asked || !truth)
        throw haptic_sculpt::Write_error("cannot write in " + folder);
    }
    const Query_timer timer;
    std::printf("single times are read in steps of %.1f ns; the mean is that of the whole batch\n", timer.resolution());
    nlohmann::json report{{"seed", seed},
                          {"queries_per_population", count},
                          {"clock_resolution_ns", timer.resolution()},
                          {"populations", nlohmann::json::array()}};
    std::size_t verdicts = 0, wrong = 0; // of ours
    for (const auto& population : sweep_populations()) {
      if (!chosen.empty() && std::find(chosen.begin(), chosen.end(), population.name) == chosen.end())
        continue;
      const std::size_t unit = program.shard.next_unit();
      if (!program.shard.takes_next())
        continue;
      std::seed_seq sequence(population.name.begin(), population.name.end()); // the same alone as among the others
      std::mt19937_64 engine(sequence);
      engine.seed(engine() ^ seed);
      const std::vector<Judged_query> queries = judged_queries(population, count, engine);
      if (!folder.empty()) {
        write(queries, asked, truth);
        continue;
      }
      const auto hits = std::count_if(queries.begin(), queries.end(), [](const auto& q) { return q.time.has_value(); });
      std::printf("%s%s: %zu queries, %td hits\n%-34s %9s %9s %10s %7s %7s %10s\n", population.name.c_str(),
                  population.degenerate ? " (degenerate)" : "", count, hits, "", "median ns", "mean ns", "p99 ns",
                  "false +", "false -", "error in u");
      nlohmann::json entry{
          {"unit", unit}, {"name", population.name},          {"degenerate", population.degenerate},
          {"hits", hits}, {"filter", filter_shares(queries)}, {"arithmetics", nlohmann::json::array()}};
      for (const Result& result : measure_all(timer, queries)) {
        char error[16] = "-";
        if (result.gives_time)
          std::snprintf(error, sizeof error, "%.1e", result.largest_error);
        std::printf("%-34s %9.0f %9.0f %10.0f %7llu %7llu %10s\n", result.name.c_str(), result.median, result.mean,
                    result.p99, static_cast<unsigned long long>(result.false_positives),
                    static_cast<unsigned long long>(result.false_negatives), error);
        entry["arithmetics"].push_back(as_json(result));
        if (result.is_ours)
          verdicts += count, wrong += result.false_positives + result.false_negatives;
      }
      std::fflush(stdout);
      report["populations"].push_back(entry);
    }
    if (!folder.empty()) {
      asked.close(), truth.close(); // a full disk shows where buffers are emptied
      std::error_code error;
      for (const char* const name : {"/queries.txt", "/truth.txt"})
        if (asked && truth && !error)
          std::filesystem::rename(folder + name + ".unfinished", folder + name, error);
      if (!asked || !truth || error)
        throw haptic_sculpt::Write_error("cannot write in " + folder);
    }
    promises.add(ours_was_wrong, "every sweep agrees with the rational oracle", verdicts, wrong);
    return report;
  });
}
