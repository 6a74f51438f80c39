// SPDX-License-Identifier: GPL-3.0-or-later
#include "read_mesh.h"
#include "refusal.h"

#include "../common/write_file.h"

#include <haptic_sculpt/surface/repair.h>

#include <nlohmann/json.hpp>

#include <string>
#include <utility>

namespace haptic_sculpt::sculpt_program {

namespace {

/// A repair as JSON; its keys: doc/use/repair.md.
std::string json_of(const Repair_report& report) {
  using Json = nlohmann::ordered_json;
  Json steps = Json::array();
  for (const Repair_step& step : report.steps) {
    Json counts = Json::object();
    for (const Repair_count& count : step.counts)
      counts[count.what] = count.number;
    steps.push_back({{"step", name_of(step.kind)},
                     {"counts", std::move(counts)},
                     {"moved", step.moved},
                     {"failure", step.failure.empty() ? Json() : Json(step.failure)}});
  }
  const Validity_report& left = report.left;
  Json faults = Json::object();
  for_each_kind_of_fault(left, [&](const char* key, const auto& list) { faults[key] = list.size(); });
  const Json all = {{"repaired", report.is_repaired()},
                    {"has_vanished", report.has_vanished},
                    {"steps", std::move(steps)},
                    {"moved", report.moved},
                    {"points_before", report.points_before},
                    {"points_removed", report.points_removed},
                    {"removed_distance", report.removed_distance},
                    {"points_added", report.points_added},
                    {"left", faults}};
  return all.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

} // namespace

void write_repair_report(const Arguments& arguments, examples::Result_writer& writer, const Sculpted_mesh& read) {
  writer.write(arguments.repair.report,
               [&](const std::string& path) { return examples::write_file(path, read.repair_report); });
}

Sculpted_mesh read_repaired(const examples::Mesh_file& file, const Arguments& arguments,
                            examples::Result_writer& writer, std::string& told) {
  Face_soup soup = file.soup();
  Repair_parameters parameters;
  parameters.delta(arguments.delta.value_or(0));
  if (arguments.repair.gap)
    parameters.gap(*arguments.repair.gap);
  if (arguments.repair.largest_hole)
    parameters.largest_hole(*arguments.repair.largest_hole);
  Repair_report report = repair(soup, parameters);
  if (report.left.has_more_intersections &&
      !(arguments.report.empty() && arguments.picture.empty() && arguments.repair.report.empty()))
    report.left = validate_soup(report.attempt, parameters.delta_length, Validity_report::all_intersections);
  told = report.message(Validity_report::Reader::user);
  Sculpted_mesh read;
  read.repair_report = json_of(report);
  if (!report.is_repaired()) {
    write_repair_report(arguments, writer, read);
    write_refusal(arguments, report.attempt, report.left);
    throw Read_error("cannot repair '" + arguments.mesh + "':\n" + told +
                     "doc/use/repair.md says what is refused, and what to do then");
  }
  read.left_out = std::move(soup.left_out);
  read.mesh = make_surface<Mesh>(soup, parameters.delta_length);
  read.is_changed = !report.steps.empty();
  return read;
}

} // namespace haptic_sculpt::sculpt_program
