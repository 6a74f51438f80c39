// SPDX-License-Identifier: GPL-3.0-or-later
// What the haptic loop's promises of passivity, stability and weightlessness are worth, measured in simulation.
#include "haptic_passivity/dynamic_limits.h"
#include "haptic_passivity/gravity_residual.h"
#include "haptic_passivity/rate_error.h"
#include "haptic_passivity/stability.h"

#include <CLI/CLI.hpp>
#include <Eigen/Eigenvalues>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>

using namespace haptic_sculpt;
using namespace haptic_sculpt::passivity_benchmark;
using Json = nlohmann::ordered_json;

namespace {

enum Exit_code { done = 0, usage = 2, cannot_write = 5, bound_not_kept = 9 };

/// Of port plus physical dissipation, J: rounding of some hundred million ticks.
constexpr double energy_bound = -1e-9;

struct Options {
  int first = 0, runs = 10, effect_runs = 6, alarm_runs = 2, poses = 2000, prescribed = 40;
  double seconds = 3, effect_seconds = 3, alarm_seconds = 60;
  std::uint64_t seed = 1;
  bool chart = false;
  std::vector<std::string> parts{"activity", "gravity", "rate", "effects", "alarms", "dynamics", "passive"};
  std::string json;
  bool has(const char* part) const { return std::find(parts.begin(), parts.end(), part) != parts.end(); }
};

Device_form form_of(int run) {
  return run % 2 == 0 ? Device_form::ditetrahedral : Device_form::general;
}

/// Runs of which the outcomes are added up.
struct Sum {
  int runs = 0, left = 0, faults = 0;
  std::size_t ticks = 0;
  double contact = 0, least = 0, least_port = 0, largest_port = 0, observer_error = 0, observer_error_whole = 0,
         least_observed = 0, inertia_energy = 0, largest_force = 0, limited = 0;
  int active = 0, alarms = 0, false_alarms = 0;

  void add(const Contact_setup& setup, const Contact_outcome& o) {
    ++runs, left += o.has_left, faults += o.fault != Loop_fault::none;
    ticks += o.ticks, contact += o.contact, active += o.least < energy_bound;
    alarms += o.least_observed < 0, false_alarms += o.least_observed < 0 && o.least >= energy_bound;
    least = std::fmin(least, o.least), least_port = std::fmin(least_port, o.least_port);
    largest_port = std::fmax(largest_port, o.largest_port);
    double& error = setup.delay == std::floor(setup.delay) ? observer_error_whole : observer_error;
    error = std::fmax(error, o.observer_error);
    least_observed = std::fmin(least_observed, o.least_observed);
    inertia_energy += o.inertia_energy, largest_force = std::fmax(largest_force, o.largest_force);
    limited += o.limited;
  }
  Json json() const {
    return {{"runs", runs},
            {"left_region", left},
            {"faults", faults},
            {"ticks_in_contact", ticks},
            {"seconds_in_contact", contact},
            {"active_runs", active},
            {"least_energy_J", least},
            {"least_port_J", least_port},
            {"largest_port_J", largest_port},
            {"observer_error_whole_delays_J", observer_error_whole},
            {"observer_error_J", observer_error},
            {"least_observed_J", least_observed},
            {"inertia_energy_J", inertia_energy},
            {"largest_force_N", largest_force},
            {"limited_share", limited / std::max(1, runs)}};
  }
};

Json passivity(const Options& options) {
  Sum sum;
  Json failures = Json::array();
  for (int run = options.first; run < options.first + options.runs; ++run) {
    const std::uint64_t seed = options.seed * 1000003 + run;
    Contact_wishes wishes;
    wishes.is_at_limit = run % 5 == 0;
    const Contact_setup setup = random_contact(seed, form_of(run), wishes, options.seconds);
    const Contact_outcome outcome = run_contact(setup, options.seconds);
    sum.add(setup, outcome);
    if (outcome.least < energy_bound)
      failures.push_back({{"seed", seed},
                          {"form", run % 2 == 0 ? "ditetrahedral" : "general"},
                          {"least_J", outcome.least},
                          {"tick_s", setup.tick},
                          {"delay", setup.delay},
                          {"stiffness", setup.coupling.stiffness},
                          {"damping", setup.coupling.damping}});
    if (run % 10 == 9)
      std::fprintf(stderr, "passive runs: %d of %d\r", run + 1 - options.first, options.runs);
  }
  Json report = sum.json();
  report["failures"] = failures;
  std::printf("passive runs: %d of %.0f s, %zu ticks in contact; least port + dissipation %.3g J, least port alone "
              "%.3g J, largest %.3g J; %d left their region\n"
              "observer off by at most %.2g J at whole delays, %.2g J at others\n",
              sum.runs, options.seconds, sum.ticks, sum.least, sum.least_port, sum.largest_port, sum.left,
              sum.observer_error_whole, sum.observer_error);
  return report;
}

Json activity_report(const Options& options) {
  Json rows = Json::array();
  for (const double delay : {0.0, 0.5, 1.0, 2.0}) {
    const Activity found = activity(options.seed, options.prescribed, delay);
    rows.push_back(
        {{"delay", delay}, {"poses", found.tried}, {"least_over_formula", found.least}, {"largest", found.largest}});
    std::printf("activity under prescribed motion, delay %.1f: from %.4f to %.4f of the formula over %d poses\n", delay,
                found.least, found.largest, found.tried);
  }
  return rows;
}

/// How far the force in the hand is from the spring's, over rate and delay; 60 mm/s, 500 N/m.
Json rates(const Options&) {
  Json rows = Json::array();
  for (const double encoder_step : {0.0, 1.53e-4})
    for (const double delay : {0.0, 0.5, 1.0})
      for (const double rate : {250.0, 500.0, 1000.0, 2000.0, 4000.0, 10000.0}) {
        const double speed = 0.06, stiffness = 500;
        const Rate_error e = rate_error(rate, delay, speed, stiffness, encoder_step);
        rows.push_back({{"rate_Hz", rate},
                        {"delay", delay},
                        {"encoder_step", encoder_step},
                        {"kvT_N", stiffness * speed / rate},
                        {"mean_N", e.mean},
                        {"largest_N", e.largest},
                        {"felt_mean_N", e.felt_mean},
                        {"felt_largest_N", e.felt_largest}});
        std::printf("error of force, %s, d %.1f, %5.0f Hz: mean %.2f mN, largest %.2f; with J turning %.2f, %.2f\n",
                    encoder_step > 0 ? "encoders" : "exact", delay, rate, 1e3 * e.mean, 1e3 * e.largest,
                    1e3 * e.felt_mean, 1e3 * e.felt_largest);
      }
  return rows;
}

/// The same runs, each effect alone.
Json effects(const Options& options) {
  Json rows = Json::array();
  const auto measure = [&](const char* name, const Contact_wishes& wishes, const auto& change) {
    Sum sum;
    for (int run = 0; run < options.effect_runs; ++run) {
      Contact_setup setup =
          random_contact(options.seed * 1000003 + 500000 + run, form_of(run), wishes, options.effect_seconds);
      change(setup);
      sum.add(setup, run_contact(setup, options.effect_seconds));
    }
    Json row = {{"effect", name}};
    row.update(sum.json());
    rows.push_back(row);
    std::printf("%-24s least port + dissipation %10.3g J, active runs %d of %d, port from %.3g to %.3g J, limits at "
                "work in %.0f %% of the ticks\n",
                name, sum.least, sum.active, sum.runs, sum.least_port, sum.largest_port, 100 * sum.limited / sum.runs);
    std::fflush(stdout);
  };
  Contact_wishes plain, bad_poses, weak;
  plain.is_at_limit = bad_poses.is_at_limit = weak.is_at_limit = true;
  bad_poses.least_condition = 4, bad_poses.most_condition = 18;
  weak.torque_limit = 0.12;
  measure("none", plain, [](Contact_setup&) {});
  measure("slew 300 N/s", plain, [](Contact_setup& s) { s.limits.slew = 300; });
  measure("slew 30 N/s", plain, [](Contact_setup& s) { s.limits.slew = 30; });
  measure("clamp 0.5 N", plain, [](Contact_setup& s) { s.limits.largest = 0.5; });
  measure("saturation 0.12 N m", weak, [](Contact_setup&) {});
  measure("fading 5 to 20", bad_poses,
          [](Contact_setup& s) { s.limits.full_condition = 5, s.limits.no_condition = 20; });
  measure("ramp 0.3 s", plain, [](Contact_setup& s) { s.limits.ramp_time = 0.3; });
  measure("burst every 0.5 s", plain, [](Contact_setup& s) { s.burst_every = 0.5; });
  measure("virtual mass 10 g", plain, [](Contact_setup& s) { s.inertia.mass = 0.01; });
  measure("virtual mass 30 g", plain, [](Contact_setup& s) { s.inertia.mass = 0.03; });
  measure("compensated inertia 0.5", plain, [](Contact_setup& s) { s.inertia.compensated = 0.5; });
  measure("k = 2 k_p", plain, [](Contact_setup& s) { s.coupling.stiffness *= 2; });
  measure("k = 10 k_p", plain, [](Contact_setup& s) { s.coupling.stiffness *= 10; });
  measure("k = 10 k_p, controller", plain,
          [](Contact_setup& s) { s.coupling.stiffness *= 10, s.controller_damping = 10; });
  return rows;
}

/// With encoders, and limits as they come: what is reported though nothing is wrong.
Json alarms(const Options& options) {
  Sum sum;
  Contact_wishes wishes;
  wishes.encoder_step = 1.53e-4, wishes.fixed_tick = 0.001;
  for (int run = 0; run < options.alarm_runs; ++run) {
    Contact_setup setup =
        random_contact(options.seed * 1000003 + 700000 + run, form_of(run), wishes, options.alarm_seconds);
    setup.limits = Force_limits();
    sum.add(setup, run_contact(setup, options.alarm_seconds));
  }
  std::printf(
      "encoders of 1.53e-4 rad, %d runs of %.0f s: faults %d, observer alarms %d, false ones %d (least %.3g J), "
      "true least %.3g J, observer off by at most %.2g J\n",
      sum.runs, options.alarm_seconds, sum.faults, sum.alarms, sum.false_alarms, sum.least_observed, sum.least,
      std::fmax(sum.observer_error, sum.observer_error_whole));
  Json report = sum.json();
  report["observer_alarms"] = sum.alarms, report["false_alarms"] = sum.false_alarms;
  return report;
}

Json gravity(const Options& options) {
  Json rows = Json::array();
  const std::pair<Residual_source, const char*> sources[] = {
      {Residual_source::encoders, "encoders"},
      {Residual_source::holding, "holding 1 ms at 60 mm/s"},
      {Residual_source::encoders_holding, "encoders and holding"},
      {Residual_source::planar_model, "planar links (the paper's)"}};
  for (const int form : {0, 1})
    for (const auto& [source, name] : sources) {
      const Gravity_residual r = gravity_residual(options.seed, form_of(form), source, 1.53e-4, options.poses);
      const char* form_name = form == 0 ? "ditetrahedral" : "general";
      rows.push_back({{"form", form_name},
                      {"source", name},
                      {"median_N", r.median},
                      {"p99_N", r.p99},
                      {"largest_N", r.largest},
                      {"condition_there", r.condition}});
      std::printf("gravity, %s, %s: median %.2f mN, p99 %.2f, largest %.1f mN (cond %.1f)\n", form_name, name,
                  1e3 * r.median, 1e3 * r.p99, 1e3 * r.largest, r.condition);
    }
  return rows;
}

/// The largest virtual mass and damping, and both sides of where a free mass begins to swing.
Json dynamics_report(const Options& options) {
  struct Loop {
    int form;
    double tick, delay;
  };
  std::vector<Loop> loops{{0, 0.001, 0}, {1, 0.001, 1}, {0, 0.004, 1}};
  if (options.chart)
    loops.insert(loops.end(),
                 {{0, 0.00025, 1}, {1, 0.00025, 0}, {0, 0.001, 0.5}, {1, 0.001, 0}, {0, 0.004, 0}, {1, 0.004, 1}});
  Json rows = Json::array();
  for (const auto& [form, tick, delay] : loops) {
    const Dynamic_limits found = dynamic_limits(form_of(form), tick, delay);
    rows.push_back({{"form", form == 0 ? "ditetrahedral" : "general"},
                    {"tick_s", tick},
                    {"delay", delay},
                    {"apparent_mass_kg", found.limits.apparent_mass},
                    {"largest_mass_kg", found.limits.largest_mass},
                    {"critical_mass_kg", found.critical_mass},
                    {"largest_damping", found.limits.largest_damping},
                    {"critical_damping", found.critical_damping},
                    {"largest_controller", found.limits.largest_controller},
                    {"largest_is_calm", found.holds},
                    {"mass_is_calm_below", found.mass_is_calm_below},
                    {"mass_swings_above", found.mass_swings_above},
                    {"damping_is_calm_below", found.damping_is_calm_below},
                    {"damping_swings_above", found.damping_swings_above}});
    std::printf("%s, T %.2f ms, d %.1f: apparent mass %.1f g; virtual mass up to %.1f g, damping up to %.2f N s/m, "
                "controller up to %.1f: %s; critical mass %.1f g: calm at 0.8 of it %d, swings at 1.2 of it %d; "
                "critical damping %.1f N s/m: calm at 0.6 of it %d, swings at 1.3 or 2 of it %d\n",
                form == 0 ? "di-tetrahedral" : "general", 1e3 * tick, delay, 1e3 * found.limits.apparent_mass,
                1e3 * found.limits.largest_mass, found.limits.largest_damping, found.limits.largest_controller,
                found.holds ? "calm" : "NOT CALM", 1e3 * found.critical_mass, found.mass_is_calm_below,
                found.mass_swings_above, found.critical_damping, found.damping_is_calm_below,
                found.damping_swings_above);
    std::fflush(stdout);
  }
  return rows;
}

/// Limits of stiffness over tick, delay and damping, at the worst pose of the ball about home.
Json chart() {
  const Device_parameters<double> device = design(Device_form::ditetrahedral, 0.005, 0, 0, 10);
  const auto home = home_pose(device);
  const double radius = workspace_radius(device, *home);
  const Worst_pose worst = worst_pose(
      device, Force_limits(), [&](const Eigen::Vector3d& p) { return (p - home->position).norm() <= 0.9 * radius; });
  const double friction = worst.friction(device);
  Json rows = Json::array(), masses = Json::array(), dampings = Json::array();
  const auto point = [&](double tick, double delay, double damping) {
    const double k_p = passive_stiffness(friction, damping, tick, delay);
    const double k_s = stable_stiffness(friction, damping, tick, delay);
    const double stable = largest_stable_stiffness(device, worst.pose, damping, tick, delay, 4 * k_s / 0.6);
    rows.push_back({{"tick_s", tick},
                    {"delay", delay},
                    {"damping", damping},
                    {"passive_formula", k_p},
                    {"stable_formula", k_s},
                    {"stable_to", stable}});
    if (damping == 0) // a slow motion is damped by b, and would not find what b costs
      rows.back()["active_from"] = activity_stiffness(device, worst.pose, 0, tick, delay);
    std::printf("T %.2f ms, d %.1f, b %.2f: k_p %.0f, k_s %.0f, stable to %.0f N/m", 1e3 * tick, delay, damping, k_p,
                k_s, stable);
    if (damping == 0)
      std::printf(", activity from %.0f", rows.back()["active_from"].get<double>());
    std::printf("\n");
    std::fflush(stdout);
  };
  for (const double delay : {0.0, 0.5, 1.0})
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0, 2.0, 4.0, 8.0})
      point(0.001, delay, share * friction);
  for (const double tick : {0.00025, 0.0005, 0.002, 0.004})
    for (const double share : {0.0, 1.0, 4.0})
      point(tick, 0, share * friction);
  for (const double tick : {0.00025, 0.001, 0.004})
    for (const double delay : {0.0, 1.0}) {
      const double k = stable_stiffness(friction, 0, tick, delay);
      const double damping = largest_stable_damping(device, worst.pose, k, tick, delay, 100 * friction);
      dampings.push_back({{"tick_s", tick}, {"delay", delay}, {"stiffness", k}, {"stable_to", damping}});
      std::printf("T %.2f ms, d %.0f, k %.0f N/m: damping stable to %.2f N s/m\n", 1e3 * tick, delay, k, damping);
      const double mass = largest_stable_mass(device, worst.pose, tick, delay, 0.4);
      masses.push_back({{"tick_s", tick}, {"delay", delay}, {"stable_to_kg", mass}});
      std::fflush(stdout);
      std::printf("T %.2f ms, d %.0f: virtual mass stable to %.1f g\n", 1e3 * tick, delay, 1e3 * mass);
    }
  const auto terms = dynamics(device, Dynamics_model::spatial, worst.pose, Device_vector<double>(0, 0, 0));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> apparent(
      apparent_mass(terms->mass, jacobian(device, worst.pose)->linear));
  std::printf("least apparent mass there %.1f g\n", 1e3 * apparent.eigenvalues()[0]);
  return {{"friction_Ns_m", friction},
          {"greatest_m_rad", worst.greatest},
          {"apparent_mass_kg", apparent.eigenvalues()[0]},
          {"rows", rows},
          {"damping", dampings},
          {"virtual_mass", masses}};
}

/// What is wrong, one sentence each.
std::vector<std::string> broken_bounds(const Json& report) {
  std::vector<std::string> broken;
  if (report.contains("passive") && report["passive"]["active_runs"] != 0)
    broken.push_back("a run within the passive limit was given energy; its seed is in the report");
  for (const Json& row : report.value("activity", Json::array()))
    if (row["delay"] == 0.0 && (row["least_over_formula"] < 0.9 || row["largest"] > 1.1))
      broken.push_back("activity does not begin within 10 % of the formula");
  if (report.contains("alarms") && (report["alarms"]["faults"] != 0 || report["alarms"]["false_alarms"] != 0))
    broken.push_back("there were false alarms");
  for (const Json& row : report.value("dynamics", Json::array())) {
    if (!row["largest_is_calm"])
      broken.push_back("a virtual mass or damping that may be asked for buzzes");
    if (!row["mass_is_calm_below"] || !row["mass_swings_above"])
      broken.push_back("a free handle does not begin to swing within 20 % of the critical mass");
    if (!row["damping_is_calm_below"] || !row["damping_swings_above"])
      broken.push_back("a damped handle does not begin to swing between 0.6 and twice the critical damping");
  }
  for (const Json& row : report.value("gravity", Json::array()))
    if (row["source"] == "encoders and holding" && row["largest_N"] > 0.06)
      broken.push_back("more than 60 mN of the mechanism's weight is left");
  return broken;
}

} // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Energy that the simulated device gives in contact with a plane, within the passive limit and beyond; "
               "what each limit of forces adds; false alarms; the weight that is left in the hand; where stability "
               "ends.");
  app.add_option("--runs", options.runs, "Of random pose, stiffness <= k_p, damping, delay, tick and hand")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--first", options.first, "Number of the first of them: shares of one large set add up to it")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--seconds", options.seconds, "Of contact in each")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--effect-runs", options.effect_runs, "For each effect")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--effect-seconds", options.effect_seconds, "Of contact in each")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--alarm-runs", options.alarm_runs, "With encoders")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--alarm-seconds", options.alarm_seconds, "Of contact in each")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--prescribed", options.prescribed, "Poses of the prescribed motion, for each delay")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--poses", options.poses, "At which the weight left is looked at")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--parts", options.parts, "What to measure")
      ->delimiter(',')
      ->check(CLI::IsMember({"activity", "gravity", "rate", "effects", "alarms", "dynamics", "passive"}))
      ->capture_default_str();
  app.add_flag("--chart", options.chart, "Where activity and instability begin, over tick, delay and damping; minutes");
  app.add_option("--seed", options.seed, "Of everything random")->capture_default_str();
  app.add_option("--json", options.json, "Write the report here");
  app.footer("Exit codes: 0 done, 2 usage, 5 cannot write, 9 a bound is not kept.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : usage;
  }
  Json report = {{"version", 1}, {"seed", options.seed}};
  const auto part = [&](const char* name, Json (*measure)(const Options&)) {
    if (options.has(name))
      report[name] = measure(options);
    std::fflush(stdout);
  };
  part("activity", activity_report), part("gravity", gravity), part("rate", rates), part("effects", effects),
      part("alarms", alarms), part("dynamics", dynamics_report);
  part("passive", passivity);
  if (options.chart)
    report["chart"] = chart();
  const std::vector<std::string> broken = broken_bounds(report);
  report["broken_bounds"] = broken;
  for (const std::string& sentence : broken)
    std::fprintf(stderr, "haptic_passivity: %s\n", sentence.c_str());
  if (!options.json.empty() && !(std::ofstream(options.json) << report.dump(1) << '\n')) {
    std::fprintf(stderr, "haptic_passivity: cannot write %s\n", options.json.c_str());
    return cannot_write;
  }
  return broken.empty() ? done : bound_not_kept;
}
