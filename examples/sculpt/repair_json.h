// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "faults_json.h"

#include <haptic_sculpt/surface/repair/Repair_report.h>

#include <nlohmann/json.hpp>

#include <string>

namespace haptic_sculpt::sculpt_program {

/// A repair as JSON; its keys: doc/use/repair.md.
inline std::string json_of(const Repair_report& report) {
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
                    {"steps", std::move(steps)},
                    {"moved", report.moved},
                    {"points_before", report.points_before},
                    {"points_removed", report.points_removed},
                    {"removed_distance", report.removed_distance},
                    {"points_added", report.points_added},
                    {"left", faults}};
  return all.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

} // namespace haptic_sculpt::sculpt_program
