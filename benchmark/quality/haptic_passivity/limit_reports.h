// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_passivity/Options.h"
#include "haptic_passivity/dynamic_limits.h"
#include "haptic_passivity/gravity_residual.h"
#include "haptic_passivity/prescribed_motion.h"
#include "haptic_passivity/rate_error.h"

#include <cstdio>
#include <utility>
#include <vector>

namespace haptic_sculpt::passivity_benchmark {

/// Where activity begins under prescribed motion, over the formula.
inline Json activity_report(const Options& options) {
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
inline Json rates(const Options&) {
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

/// The weight that is left in the hand, by where it comes from.
inline Json gravity(const Options& options) {
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
inline Json dynamics_report(const Options& options) {
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
    std::printf(
        "%s, T %.2f ms, d %.1f: apparent mass %.1f g; virtual mass up to %.1f g, damping up to %.2f N s/m, "
        "controller up to %.1f: %s; critical mass %.1f g: calm at 0.8 of it %d, swings at 1.2 of it %d; "
        "critical damping %.1f N s/m: calm at 0.6 of it (or at twice the largest) %d, swings at 1.3 or 2 of it %d\n",
        form == 0 ? "di-tetrahedral" : "general", 1e3 * tick, delay, 1e3 * found.limits.apparent_mass,
        1e3 * found.limits.largest_mass, found.limits.largest_damping, found.limits.largest_controller,
        found.holds ? "calm" : "NOT CALM", 1e3 * found.critical_mass, found.mass_is_calm_below, found.mass_swings_above,
        found.critical_damping, found.damping_is_calm_below, found.damping_swings_above);
    std::fflush(stdout);
  }
  return rows;
}

} // namespace haptic_sculpt::passivity_benchmark
