// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

namespace haptic_sculpt::robustness {

using Json = nlohmann::ordered_json;

/// What is counted of drags.
struct Drag_tally {
  std::size_t drags = 0, reached = 0, blocked = 0;
  std::size_t short_asked = 0, short_arrived = 0;
  std::size_t through_asked = 0, through_stayed = 0, through_lazy = 0;
  std::size_t through_unexplained = 0; ///< stayed, and no contact says why
  std::size_t validations = 0, invalid = 0, changed = 0, slow_stops = 0;
  std::size_t contradictions = 0; ///< results that contradict themselves
  double largest_stop_error = 0; ///< in clearances; stops with one contact whose plane is determined
  double nanoseconds = 0, longest = 0; ///< of all drags together, and of one; ns

  bool is_any_promise_broken() const { return invalid + changed + contradictions + through_lazy > 0; }

  Drag_tally& operator+=(const Drag_tally& t) {
    drags += t.drags, reached += t.reached, blocked += t.blocked;
    short_asked += t.short_asked, short_arrived += t.short_arrived;
    through_asked += t.through_asked, through_stayed += t.through_stayed, through_lazy += t.through_lazy;
    through_unexplained += t.through_unexplained;
    validations += t.validations, invalid += t.invalid, changed += t.changed, slow_stops += t.slow_stops;
    contradictions += t.contradictions;
    largest_stop_error = std::max(largest_stop_error, t.largest_stop_error);
    nanoseconds += t.nanoseconds;
    longest = std::max(longest, t.longest);
    return *this;
  }
  Json json() const {
    return {{"drags", drags},
            {"reached", reached},
            {"blocked", blocked},
            {"short_asked", short_asked},
            {"short_arrived", short_arrived},
            {"through_asked", through_asked},
            {"through_stayed", through_stayed},
            {"through_lazy", through_lazy},
            {"through_unexplained", through_unexplained},
            {"validations", validations},
            {"invalid", invalid},
            {"changed_elsewhere", changed},
            {"contradictions", contradictions},
            {"stops_beyond_two_clearances", slow_stops},
            {"largest_stop_error_in_clearances", largest_stop_error},
            {"mean_ns", drags > 0 ? nanoseconds / static_cast<double>(drags) : 0},
            {"longest_ns", longest}};
  }
};

} // namespace haptic_sculpt::robustness
