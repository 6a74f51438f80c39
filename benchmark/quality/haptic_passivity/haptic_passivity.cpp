// SPDX-License-Identifier: GPL-3.0-or-later
// What the haptic loop's promises of passivity, stability and weightlessness are worth, measured in simulation.
#include "Benchmark_program.h"
#include "haptic_passivity/chart.h"
#include "haptic_passivity/contact_reports.h"
#include "haptic_passivity/damping_limit.h"
#include "haptic_passivity/limit_reports.h"

#include <CLI/CLI.hpp>

#include <cstdio>

using namespace haptic_sculpt::passivity_benchmark;

namespace {

constexpr int bound_not_kept = 9;

struct Bounds {
  std::size_t asked = 0;
  std::vector<std::string> broken; ///< what is wrong, one sentence each

  void add(bool is_kept, const char* otherwise) {
    ++asked;
    if (!is_kept)
      broken.push_back(otherwise);
  }
};

Bounds bounds(const Json& report) {
  Bounds found;
  if (report.contains("passive")) {
    for (const Json& sum : {report["passive"], report["passive"]["as_shipped"]}) {
      found.add(sum["active_runs"] == 0, "a run within the passive limit was given energy; its seed is in the report");
      found.add(sum["faults"] == 0, "a run within the passive limit ended as a fault; its seed is in the report");
      found.add(sum["runs"] == 0 || sum["ticks_in_contact"] > 0,
                "no run within the passive limit has touched anything, which says nothing of energy");
    }
  }
  if (report.contains("knocks"))
    found.add(report["knocks"]["failures"].empty(),
              "a knock gave energy, was not calm after half a second, or ended as a fault; its seed is in the report");
  for (const Json& row : report.value("activity", Json::array()))
    if (row["delay"] == 0.0)
      found.add(row["least_over_formula"] >= 0.9 && row["largest"] <= 1.1,
                "activity does not begin within 10 % of the formula");
  if (report.contains("alarms"))
    found.add(report["alarms"]["faults"] == 0 && report["alarms"]["false_alarms"] == 0, "there were false alarms");
  for (const Json& row : report.value("dynamics", Json::array())) {
    found.add(row["largest_is_calm"], "a virtual mass or damping that may be asked for buzzes");
    found.add(row["mass_is_calm_below"] && row["mass_swings_above"],
              "a free handle does not begin to swing within 20 % of the critical mass");
    found.add(row["damping_is_calm_below"] && row["damping_swings_above"],
              "a damped handle does not begin to swing between 0.6 (or twice what may be asked for) and twice the "
              "critical damping");
  }
  for (const Json& row : report.value("damping", Json::array()))
    found.add(row["calm"] == row["hands"], "a damping that may be asked for buzzes in a hand; which is in the report");
  for (const Json& row : report.value("gravity", Json::array()))
    if (row["source"] == "encoders and holding")
      found.add(row["largest_N"] <= 0.06, "more than 60 mN of the mechanism's weight is left");
  return found;
}

} // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Energy that the simulated device gives in contact with a plane, within the passive limit and beyond; "
               "what each limit of forces adds; false alarms; the weight that is left in the hand; where stability "
               "ends. Exit: 9 a bound is not kept.");
  app.add_option("--runs", options.runs, "Of random pose, stiffness <= k_p, damping, delay, tick and hand")
      ->check(haptic_sculpt::benchmark::positive_number)
      ->capture_default_str();
  app.add_option("--first", options.first, "Number of the first of them: shares of one large set add up to it")
      ->check(CLI::Range(0, 1000000000))
      ->capture_default_str();
  app.add_option("--knock-runs", options.knock_runs, "Of a hand that comes down fast, or a handle that is thrown")
      ->check(haptic_sculpt::benchmark::positive_number)
      ->capture_default_str();
  app.add_option("--seconds", options.seconds, "Of contact in each")
      ->check(haptic_sculpt::benchmark::positive_number)
      ->capture_default_str();
  app.add_option("--effect-runs", options.effect_runs, "For each effect")
      ->check(haptic_sculpt::benchmark::positive_number)
      ->capture_default_str();
  app.add_option("--effect-seconds", options.effect_seconds, "Of contact in each")
      ->check(haptic_sculpt::benchmark::positive_number)
      ->capture_default_str();
  app.add_option("--alarm-runs", options.alarm_runs, "With encoders")
      ->check(haptic_sculpt::benchmark::positive_number)
      ->capture_default_str();
  app.add_option("--alarm-seconds", options.alarm_seconds, "Of contact in each")
      ->check(haptic_sculpt::benchmark::positive_number)
      ->capture_default_str();
  app.add_option("--damping-hands", options.damping_hands,
                 "In which the largest damping is tried, the stiffest first, for each tick and delay")
      ->check(CLI::Range(1, 15))
      ->capture_default_str();
  app.add_option("--prescribed", options.prescribed, "Poses of the prescribed motion, for each delay")
      ->check(haptic_sculpt::benchmark::positive_number)
      ->capture_default_str();
  app.add_option("--poses", options.poses, "At which the weight left is looked at")
      ->check(haptic_sculpt::benchmark::positive_number)
      ->capture_default_str();
  app.add_option("--parts", options.parts, "What to measure")
      ->delimiter(',')
      ->check(CLI::IsMember(
          {"activity", "gravity", "rate", "effects", "alarms", "dynamics", "damping", "knocks", "passive"}))
      ->capture_default_str();
  app.add_flag("--chart", options.chart, "Where activity and instability begin, over tick, delay and damping; minutes");
  app.add_option("--seed", options.seed, "Of everything random")->capture_default_str();
  haptic_sculpt::benchmark::Benchmark_program program("haptic_passivity", app, "part");
  return program.run(argc, argv, [&](haptic_sculpt::benchmark::Promises& promises) {
    auto& shard = program.shard;
    Json report = {{"version", 1}, {"seed", options.seed}};
    const auto part = [&](const char* name, Json (*measure)(const Options&)) {
      if (options.has(name) && shard.takes_next())
        report[name] = measure(options);
      std::fflush(stdout);
    };
    part("activity", activity_report), part("gravity", gravity), part("rate", rates), part("effects", effects),
        part("alarms", alarms), part("dynamics", dynamics_report);
    part("damping", damping_in_hands), part("knocks", knocks), part("passive", passivity);
    if (options.chart && shard.takes_next())
      report["chart"] = chart();
    const Bounds found = bounds(report);
    report["broken_bounds"] = found.broken;
    promises.add(bound_not_kept, "every bound of energy, stability and weight is kept", found.asked,
                 found.broken.size());
    for (const std::string& sentence : found.broken)
      std::fprintf(stderr, "haptic_passivity: %s\n", sentence.c_str());
    return report;
  });
}
