// SPDX-License-Identifier: GPL-3.0-or-later
// Time of whole drags against their errors, with sweeps decided in several arithmetics, on the same scripts.
#include "Benchmark_program.h"
#include "drag_speed_error/Drag_script.h"
#include "quantile.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <numeric>

namespace {

using namespace haptic_sculpt::benchmark;
using Json = nlohmann::ordered_json;

constexpr int exact_is_wrong = 10;

double mean(const std::vector<double>& values) {
  return values.empty() ? 0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app{"Time of whole drags against their errors: the same scripts with sweeps decided in doubles, by the 1997 "
               "paper's equations "
               "with an epsilon, in long doubles and by the exact traits. Every drag is judged by GMP rationals over "
               "all faces: has it "
               "touched or crossed anything on its way, and was it stopped though its way was free? What went wrong is "
               "counted and "
               "taken back, so each drag starts from a valid mesh. Exit: 10 the exact traits were wrong."};
  std::string response = "stop";
  std::uint64_t seed = 1;
  std::size_t drags = 2000;
  std::vector<std::string> chosen;
  app.add_option("--seed", seed, "Seed of the scripts")->capture_default_str();
  app.add_option("--drags", drags, "Drags of each script")->capture_default_str()->check(positive_number);
  app.add_option("--response", response, "What a blocked drag does")
      ->capture_default_str()
      ->check(CLI::IsMember({"stop", "slide"}));
  app.add_option("--script", chosen, "Only these scripts")->check(CLI::IsMember(drag_script_names()));
  Benchmark_program program("drag_speed_error", app, "script");
  return program.run(argc, argv, [&](Promises& promises) {
    Json report{{"seed", seed}, {"drags_per_script", drags}, {"response", response}, {"scripts", Json::array()}};
    std::size_t exact_drags = 0, exact_wrong = 0;
    std::printf("seed %llu, %zu drags a script, response %s\n", static_cast<unsigned long long>(seed), drags,
                response.c_str());
    for (const std::string& name : chosen.empty() ? drag_script_names() : chosen) {
      const std::size_t unit = program.shard.next_unit();
      if (!program.shard.takes_next())
        continue;
      const Drag_script script = drag_script(name, drags, seed);
      std::printf("%s: %zu triangles\n%-22s %10s %10s %10s %8s %8s %9s %8s\n", name.c_str(), script.faces.size(), "",
                  "median us", "mean us", "p99 us", "blocked", "crossed", "of these", "wrongly");
      std::printf("%-22s %10s %10s %10s %8s %8s %9s %8s\n", "", "", "", "", "", "", "invalid", "blocked");
      Json arithmetics = Json::array();
      for (const Arithmetic arithmetic :
           {Arithmetic::doubles, Arithmetic::paper, Arithmetic::long_doubles, Arithmetic::exact}) {
        const bool slides = response == "slide", is_exact = arithmetic == Arithmetic::exact;
        Drag_counts c = is_exact ? measure_exact(script, slides) : measure_rounded(script, slides, arithmetic);
        if (is_exact)
          exact_drags += c.drags, exact_wrong += c.crossed + c.wrongly_blocked;
        const double median = quantile(c.nanoseconds, 0.5) * 1e-3, p99 = quantile(c.nanoseconds, 0.99) * 1e-3;
        std::printf("%-22s %10.2f %10.2f %10.2f %8zu %8zu %9zu %8zu\n", name_of(arithmetic), median,
                    mean(c.nanoseconds) * 1e-3, p99, c.blocked, c.crossed, c.self_intersecting, c.wrongly_blocked);
        std::fflush(stdout);
        arithmetics.push_back({{"name", name_of(arithmetic)},
                               {"drags", c.drags},
                               {"median_us", median},
                               {"mean_us", mean(c.nanoseconds) * 1e-3},
                               {"p99_us", p99},
                               {"blocked", c.blocked},
                               {"crossed", c.crossed},
                               {"self_intersecting", c.self_intersecting},
                               {"wrongly_blocked", c.wrongly_blocked}});
      }
      report["scripts"].push_back({{"unit", unit},
                                   {"name", name},
                                   {"triangles", script.faces.size()},
                                   {"arithmetics", std::move(arithmetics)}});
    }
    promises.add(exact_is_wrong, "the exact traits cross nothing and stop no free drag", exact_drags, exact_wrong);
    return report;
  });
}
