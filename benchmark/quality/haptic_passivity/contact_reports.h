// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_passivity/Options.h"
#include "haptic_passivity/Random_contacts.h"
#include "haptic_rendering/knock.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace haptic_sculpt::passivity_benchmark {

/// Of port plus physical dissipation, J: rounding of some hundred million ticks.
constexpr double energy_bound = -1e-9;

/// Whether an energy is below a bound; one that is no number is.
inline bool is_below(double energy, double bound) {
  return !(energy >= bound);
}

/// Of the same with all that ships, J: what a stiffness that grows with the ramp gives who presses meanwhile.
constexpr double energy_bound_as_shipped = -1e-3;

/// Runs of which the outcomes are added up.
struct Sum {
  double bound = energy_bound; ///< a run that gives more is active
  int runs = 0, left = 0, faults = 0, without_contact = 0;
  std::size_t ticks = 0;
  double contact = 0, least = 0, least_port = 0, largest_port = 0, observer_error = 0, observer_error_whole = 0,
         least_observed = 0, mass_energy = 0, largest_force = 0, limited = 0, off = 0, most_off = 0;
  int active = 0, alarms = 0, false_alarms = 0;

  void add(const Contact_setup& setup, const Contact_outcome& o) {
    ++runs, left += o.has_left, faults += o.fault != Loop_fault::none, without_contact += o.ticks == 0;
    ticks += o.ticks, contact += o.contact, active += is_below(o.least, bound);
    alarms += o.least_observed < 0, false_alarms += o.least_observed < 0 && !is_below(o.least, bound);
    least = less_of(least, o.least), least_port = less_of(least_port, o.least_port);
    largest_port = greater_of(largest_port, o.largest_port);
    double& error = setup.delay == std::floor(setup.delay) ? observer_error_whole : observer_error;
    error = greater_of(error, o.observer_error);
    least_observed = less_of(least_observed, o.least_observed);
    mass_energy += o.mass_energy, largest_force = greater_of(largest_force, o.largest_force);
    limited += o.limited, off += o.off, most_off = greater_of(most_off, o.most_off);
  }
  Json json() const {
    return {{"runs", runs},
            {"left_region", left},
            {"faults", faults},
            {"runs_without_contact", without_contact},
            {"ticks_in_contact", ticks},
            {"seconds_in_contact", contact},
            {"active_runs", active},
            {"least_energy_J", least},
            {"least_port_J", least_port},
            {"largest_port_J", largest_port},
            {"observer_error_whole_delays_J", observer_error_whole},
            {"observer_error_J", observer_error},
            {"least_observed_J", least_observed},
            {"mass_energy_J", mass_energy},
            {"largest_force_N", largest_force},
            {"limited_share", limited / std::max(1, runs)},
            {"force_off_mean_N", off / std::max(1, runs)},
            {"force_off_largest_N", most_off}};
  }
};

/// Every default of the loop. Encoders, motors and a calm stiffness are those of Contact_wishes::as_built().
inline void make_as_it_ships(Contact_setup& setup) {
  const Haptic_parameters defaults;
  setup.limits = defaults.limits, setup.follows_pose = defaults.follows_pose;
  setup.controller_damping = defaults.controller_damping;
}

/// Random runs within the passive limit: every second with nothing else at work and exact angles, the others with all
/// that ships.
inline Json passivity(const Options& options) {
  Sum sum, shipped{energy_bound_as_shipped};
  Json failures = Json::array();
  for (int run = options.first; run < options.first + options.runs; ++run) {
    const std::uint64_t seed = options.seed * 1000003 + run;
    const bool is_shipped = run / 2 % 2 == 1;
    Contact_wishes wishes = is_shipped ? Contact_wishes::as_built() : Contact_wishes();
    wishes.is_at_limit = run % 5 == 0;
    Contact_setup setup = random_contact(seed, form_of(run), wishes, options.seconds);
    if (is_shipped)
      make_as_it_ships(setup);
    const Contact_outcome outcome = run_contact(setup, options.seconds);
    Sum& of_its_kind = is_shipped ? shipped : sum;
    of_its_kind.add(setup, outcome);
    if (is_below(outcome.least, of_its_kind.bound) || outcome.fault != Loop_fault::none)
      failures.push_back({{"seed", seed},
                          {"form", run % 2 == 0 ? "ditetrahedral" : "general"},
                          {"least_J", outcome.least},
                          {"fault", name_of(outcome.fault)},
                          {"tick_s", setup.tick},
                          {"delay", setup.delay},
                          {"stiffness", setup.coupling.stiffness},
                          {"damping", setup.coupling.damping}});
    if (run % 10 == 9)
      std::fprintf(stderr, "passive runs: %d of %d\r", run + 1 - options.first, options.runs);
  }
  Json report = sum.json();
  report["as_shipped"] = shipped.json();
  report["failures"] = failures;
  std::printf("as it ships: %d runs, %zu ticks in contact; least port + dissipation %.3g J, faults %d\n", shipped.runs,
              shipped.ticks, shipped.least, shipped.faults);
  std::printf(
      "nothing else at work: %d of %.0f s, %zu ticks in contact; least port + dissipation %.3g J, least port alone "
      "%.3g J, largest %.3g J; %d left their region\n"
      "observer off by at most %.2g J at whole delays, %.2g J at others\n",
      sum.runs, options.seconds, sum.ticks, sum.least, sum.least_port, sum.largest_port, sum.left,
      sum.observer_error_whole, sum.observer_error);
  return report;
}

/// The same runs, each effect alone.
inline Json effects(const Options& options) {
  Json rows = Json::array();
  const auto measure = [&](const char* name, const Contact_wishes& wishes, const auto& change,
                           double bound = energy_bound) {
    Sum sum{bound};
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
                "work in %.0f %% of the ticks, force off by %.3g N in the mean, %.3g N at most\n",
                name, sum.least, sum.active, sum.runs, sum.least_port, sum.largest_port, 100 * sum.limited / sum.runs,
                sum.off / sum.runs, sum.most_off);
    std::fflush(stdout);
  };
  Contact_wishes plain, bad_poses, weak, stepped, built = Contact_wishes::as_built();
  plain.is_at_limit = bad_poses.is_at_limit = weak.is_at_limit = stepped.is_at_limit = built.is_at_limit = true;
  stepped.encoder_step = 1.53e-4;
  bad_poses.least_condition = 4, bad_poses.most_condition = 18;
  weak.torque_limit = 0.12;
  measure("none", plain, [](Contact_setup&) {});
  measure("all that ships", built, make_as_it_ships, energy_bound_as_shipped);
  measure(
      "all that ships, work cut", built, // a plane takes no work by itself
      [](Contact_setup& s) { make_as_it_ships(s), s.starved_share = 0.1; }, energy_bound_as_shipped);
  measure("slew 300 N/s", plain, [](Contact_setup& s) { s.limits.slew = 300; });
  measure("slew 30 N/s", plain, [](Contact_setup& s) { s.limits.slew = 30; });
  measure("clamp 0.5 N", plain, [](Contact_setup& s) { s.limits.largest = 0.5; });
  measure("saturation 0.12 N m", weak, [](Contact_setup&) {});
  measure("fading 5 to 20", bad_poses,
          [](Contact_setup& s) { s.limits.full_condition = 5, s.limits.no_condition = 20; });
  measure("ramp 0.3 s", plain, [](Contact_setup& s) { s.limits.ramp_time = 0.3; });
  measure("encoders 1.53e-4 rad", stepped, [](Contact_setup&) {});
  measure("controller", plain, [](Contact_setup& s) { s.controller_damping = s.largest_controller() / 2; });
  measure("work cut, 10 % of ticks", plain, [](Contact_setup& s) { s.starved_share = 0.1; });
  measure("work cut, slew 300 N/s", plain, [](Contact_setup& s) { s.starved_share = 0.1, s.limits.slew = 300; });
  measure("k = 2 k_p, by the pose", bad_poses,
          [](Contact_setup& s) { s.coupling.stiffness *= 2, s.follows_pose = true, s.greatest = 1e9; });
  measure("burst every 0.5 s", plain, [](Contact_setup& s) { s.burst_every = 0.5; });
  measure("virtual mass 10 g", plain, [](Contact_setup& s) { s.virtual_mass.mass = 0.01; });
  measure("virtual mass 30 g", plain, [](Contact_setup& s) { s.virtual_mass.mass = 0.03; });
  measure("k = 2 k_p", plain, [](Contact_setup& s) { s.coupling.stiffness *= 2; });
  measure("k = 10 k_p", plain, [](Contact_setup& s) { s.coupling.stiffness *= 10; });
  measure("k = 10 k_p, controller", plain,
          [](Contact_setup& s) { s.coupling.stiffness *= 10, s.controller_damping = 10; });
  return rows;
}

/// Knocks at random: both forms, 0.5 to 10 kHz, delay to 2 ticks, k to 0.95 of what may be asked for, b to 0.95 b_phys,
/// named hands and thrown, along any direction; all that ships.
inline Json knocks(const Options& options) {
  const Knocked_device devices[] = {Knocked_device(form_of(0)), Knocked_device(form_of(1))};
  const std::optional<Simulated_hand> hands[] = {Simulated_hand::finger(), Simulated_hand::arm(),
                                                 Simulated_hand::measured_arm(), std::nullopt};
  double least = 0, ripple = 0, swinging_ripple = 0;
  int faults = 0, restless = 0, active = 0;
  Json failures = Json::array(), rows = Json::array();
  for (const char* name : {"finger", "arm", "measured_arm", "thrown"})
    for (const char* form : {"ditetrahedral", "general"})
      rows.push_back({{"hand", name}, {"form", form}, {"runs", 0}, {"least_energy_J", 0.0}, {"ripple_N", 0.0}});
  for (int run = options.first; run < options.first + options.knock_runs; ++run) {
    const std::uint64_t seed = options.seed * 1000003 + 900000 + run;
    Draw draw(seed);
    Knock k;
    const int hand = run / 2 % 4;
    k.rate = draw.logarithmic(500, 10000), k.delay = draw.chance(0.3) ? 0 : draw(0, 2), k.hand = hands[hand];
    k.stiffness_share = draw(0.1, k.hand ? 0.95 : 0.5), k.damping_share = draw.chance(0.4) ? 0 : draw(0, 0.95);
    k.normal = draw.direction();
    k.wait = draw.chance(0.2) ? 0 : 0.35; // while the ramp is under way, and after it
    const Knock_outcome o = run_knock(knock(devices[run % 2], k), k.wait);
    const bool swings = hand == 2; // on its own arm, for a second
    const bool is_restless = !swings && !(o.ripple <= largest_restlessness);
    Json& row = rows[static_cast<std::size_t>(2 * hand + run % 2)];
    row["runs"] = row["runs"].get<int>() + 1;
    row["least_energy_J"] = less_of(row["least_energy_J"].get<double>(), o.run.least);
    row["ripple_N"] = greater_of(row["ripple_N"].get<double>(), o.ripple);
    least = less_of(least, o.run.least);
    (swings ? swinging_ripple : ripple) = greater_of(swings ? swinging_ripple : ripple, o.ripple);
    faults += o.run.fault != Loop_fault::none, restless += is_restless;
    active += is_below(o.run.least, energy_bound_as_shipped);
    if (is_restless || is_below(o.run.least, energy_bound_as_shipped) || o.run.fault != Loop_fault::none)
      failures.push_back({{"seed", seed},
                          {"form", run % 2},
                          {"hand", hand},
                          {"wait_s", k.wait},
                          {"rate_Hz", k.rate},
                          {"delay", k.delay},
                          {"share_of_largest_stiffness", k.stiffness_share},
                          {"share_of_b_phys", k.damping_share},
                          {"least_J", o.run.least},
                          {"ripple_N", o.ripple},
                          {"fault", name_of(o.run.fault)}});
  }
  std::printf(
      "knocks: %d, seed %llu; least port + dissipation %.3g J, %d below %g; not calm %d (ripple at most %.3f N; "
      "measured_arm, which swings on itself, %.3f N); faults %d\n",
      options.knock_runs, static_cast<unsigned long long>(options.seed), least, active, energy_bound_as_shipped,
      restless, ripple, swinging_ripple, faults);
  for (const Json* list : {&rows, &failures})
    for (const Json& line : *list)
      std::printf("  %s\n", line.dump().c_str());
  return {{"runs", options.knock_runs}, {"least_energy_J", least}, {"active_runs", active}, {"restless", restless},
          {"faults", faults},           {"ripple_N", ripple},      {"measured_arm_ripple_N", swinging_ripple},
          {"rows", rows},               {"failures", failures}};
}

/// With encoders, and limits as they come: what is reported though nothing is wrong.
inline Json alarms(const Options& options) {
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

} // namespace haptic_sculpt::passivity_benchmark
