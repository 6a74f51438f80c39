// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_REPAIR_JSON_H
#define HAPTIC_SCULPT_EXAMPLES_REPAIR_JSON_H

#include <haptic_sculpt/surface/repair/Repair_report.h>

#include <nlohmann/json.hpp>

#include <string>

namespace haptic_sculpt::sculpt_program {

/// A repair as JSON; its keys: doc/repair.md.
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
  const Json faults = {{"non_finite_vertices", left.non_finite_vertices.size()},
                       {"non_triangular_faces", left.non_triangular_faces.size()},
                       {"degenerate_faces", left.degenerate_faces.size()},
                       {"low_faces", left.low_faces.size()},
                       {"boundary_edges", left.boundary_edges.size()},
                       {"non_manifold_edges", left.non_manifold_edges.size()},
                       {"inconsistently_oriented_edges", left.inconsistently_oriented_edges.size()},
                       {"non_manifold_vertices", left.non_manifold_vertices.size()},
                       {"coincident_vertices", left.coincident_vertices.size()},
                       {"intersecting_faces", left.intersecting_faces.size()}};
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

#endif
