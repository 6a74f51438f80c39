// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <string>

namespace haptic_sculpt::robustness {

/// What is counted of mixed edits.
struct Edit_tally {
  struct Row {
    std::size_t asked = 0, done = 0;
    std::map<std::string, std::size_t> refused; ///< by reason
  };
  std::map<std::string, Row> rows; ///< by kind of edit, e.g. "insert_face near a corner"
  std::size_t edits = 0, strokes = 0, validations = 0, invalid = 0, changed = 0;
  std::size_t histories = 0, undo_differs = 0, redo_differs = 0; ///< undone and redone from one end to the other
  std::size_t creations_done = 0, creations_judged = 0, creations_wrongly_accepted = 0,
              creations_wrongly_refused = 0; ///< what is feasible is one or the other
  std::size_t longest_history = 0;

  bool is_any_promise_broken() const {
    return invalid + undo_differs + redo_differs + changed + creations_wrongly_accepted > 0;
  }

  void count(const std::string& kind, const char* refusal) {
    ++edits;
    Row& row = rows[kind];
    ++row.asked;
    if (refusal == nullptr)
      ++row.done;
    else
      ++row.refused[refusal];
  }

  std::size_t feasible_creations() const { return creations_done + creations_wrongly_refused; }

  Edit_tally& operator+=(const Edit_tally& t) {
    for (const auto& [kind, row] : t.rows) {
      rows[kind].asked += row.asked, rows[kind].done += row.done;
      for (const auto& [reason, count] : row.refused)
        rows[kind].refused[reason] += count;
    }
    edits += t.edits, strokes += t.strokes, validations += t.validations, invalid += t.invalid;
    changed += t.changed;
    histories += t.histories, undo_differs += t.undo_differs, redo_differs += t.redo_differs;
    creations_done += t.creations_done, creations_wrongly_refused += t.creations_wrongly_refused;
    creations_judged += t.creations_judged, creations_wrongly_accepted += t.creations_wrongly_accepted;
    longest_history = std::max(longest_history, t.longest_history);
    return *this;
  }

  std::size_t done() const {
    std::size_t sum = 0;
    for (const auto& entry : rows)
      sum += entry.second.done;
    return sum;
  }

  nlohmann::ordered_json json() const {
    nlohmann::ordered_json kinds = nlohmann::ordered_json::object();
    for (const auto& [kind, row] : rows)
      kinds[kind] = {{"asked", row.asked}, {"done", row.done}, {"refused", row.refused}};
    return {{"edits", edits},
            {"strokes", strokes},
            {"done", done()},
            {"validations", validations},
            {"invalid", invalid},
            {"histories", histories},
            {"undo_differs", undo_differs},
            {"redo_differs", redo_differs},
            {"changed_elsewhere", changed},
            {"feasible_creations", feasible_creations()},
            {"feasible_creations_refused", creations_wrongly_refused},
            {"creations_judged", creations_judged},
            {"infeasible_creations_accepted", creations_wrongly_accepted},
            {"longest_history", longest_history},
            {"kinds", kinds}};
  }
};

} // namespace haptic_sculpt::robustness
