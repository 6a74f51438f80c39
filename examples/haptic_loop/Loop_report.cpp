// SPDX-License-Identifier: GPL-3.0-or-later
#include "Loop_report.h"

#include "../common/json_words.h"

#include <haptic_sculpt/version.h>

#include <iomanip>

namespace haptic_sculpt::loop_program {
namespace {

using nlohmann::json;

json percentiles(const Tick_statistics& s) {
  return {{"p50", s.percentile(0.5)},
          {"p99", s.percentile(0.99)},
          {"p999", s.percentile(0.999)},
          {"p9999", s.percentile(0.9999)},
          {"max", s.largest()}};
}

} // namespace

std::string report_of(const Run_result& r, const Settings& settings, const std::vector<std::string>& notes) {
  json faults = json::array();
  for (const auto& [time, what] : r.faults)
    faults.push_back({{"t", time}, {"what", what}});
  json happened = json::object(); // null: not
  for (int what = 0; what < Happenings::number; ++what)
    happened[Happenings::name_of(static_cast<Happenings::What>(what))] =
        std::isfinite(r.happened[what]) ? json(r.happened[what]) : json();
  const json report = {{"version", HAPTIC_SCULPT_VERSION},
                       {"ticks", r.ticks},
                       {"missed", r.missed},
                       {"missed_by_cpu", r.missed_by_cpu},
                       {"missed_by_wakeup", r.missed_by_wakeup},
                       {"cpu_ns", percentiles(r.cpu)},
                       {"wall_ns", percentiles(r.wall)},
                       {"wakeup_ns", percentiles(r.wakeup)},
                       {"allocations", r.allocations},
                       {"force", {{"max", r.largest_force}, {"free_max", r.largest_free_force}}},
                       {"energy",
                        {{"port", r.port},
                         {"dissipated", r.dissipated},
                         {"observer", r.observed},
                         {"observer_least", r.least_observed},
                         {"virtual_mass", r.mass_energy},
                         {"is_true", r.has_true_energy}}},
                       {"limits",
                        {{"passive_k", r.passive_stiffness},
                         {"calm_k", std::isfinite(r.calm_stiffness) ? json(r.calm_stiffness) : json()}, // null: none
                         {"stable_k", nullptr},
                         {"friction", r.friction},
                         {"largest_b", r.largest_damping},
                         {"largest_mass", r.largest_mass},
                         {"largest_controller", r.largest_controller}}},
                       {"edits",
                        {{"grabbed", r.grabbed},
                         {"created", r.created},
                         {"removed", r.removed},
                         {"released", r.released},
                         {"refused", r.refused}}},
                       {"happened", happened},
                       {"faults", faults},
                       {"log", {{"ticks", r.ticks_written}, {"lost", r.log_lost}, {"failure", r.log_failure}}},
                       {"valid", r.is_valid ? json(*r.is_valid) : json()},
                       {"interrupted", r.is_cut_short},
                       {"map", r.map},
                       {"settings", json_of(settings)},
                       {"notes", notes}};
  return examples::text_of(report, 2) + "\n";
}

void print_summary(std::ostream& out, const Run_result& r, const Settings& settings) {
  const auto microseconds = [](std::uint64_t ns) { return static_cast<double>(ns) / 1000; };
  out << std::fixed << std::setprecision(1) << r.ticks << " ticks at " << settings.rate
      << " Hz; CPU time of a tick, microseconds: median " << microseconds(r.cpu.percentile(0.5)) << ", 99.9 % "
      << microseconds(r.cpu.percentile(0.999)) << ", largest " << microseconds(r.cpu.largest()) << "; missed "
      << r.missed << " (by CPU time " << r.missed_by_cpu << "), woken late " << r.missed_by_wakeup << ", allocations "
      << r.allocations << '\n';
  out << std::setprecision(3) << "force: at most " << r.largest_force << " N, in free motion " << r.largest_free_force
      << " N; stiffness " << settings.stiffness << " N/m, passive up to " << r.passive_stiffness << ", calm up to "
      << r.calm_stiffness << '\n';
  out << std::setprecision(6) << "energy: from the hand " << r.port << " J, friction " << r.dissipated
      << " J, observer " << r.observed << " J\n";
  out << "edits: " << r.grabbed << " grabbed, " << r.created << " created, " << r.removed << " removed, " << r.refused
      << " refused; mesh "
      << (!r.is_valid   ? "not looked at"
          : *r.is_valid ? "valid"
                        : "NOT VALID")
      << '\n';
  for (const auto& [time, what] : r.faults)
    out << "fault at " << time << " s: " << what
        << (what == std::string("torn") ? "; the run has ended\n" : "; the force has been taken back\n");
}

} // namespace haptic_sculpt::loop_program
