// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

namespace haptic_sculpt::robustness {

/// What is counted of drags with extreme targets and lengths.
struct Extreme_tally {
  std::size_t drags = 0, reached = 0;
  std::size_t refused = 0, settings_refused = 0; ///< with an error
  std::size_t not_begun = 0;                     ///< drags of meshes that no Sculptor takes
  std::size_t not_finite = 0, invalid = 0, moved_though_refused = 0;
  std::size_t contradictions = 0; ///< results that contradict themselves
  std::size_t farther = 0; ///< a vertex ended farther from its target than it began

  Extreme_tally& operator+=(const Extreme_tally& t) {
    drags += t.drags, reached += t.reached, refused += t.refused, settings_refused += t.settings_refused;
    not_begun += t.not_begun;
    not_finite += t.not_finite, invalid += t.invalid, moved_though_refused += t.moved_though_refused,
        farther += t.farther, contradictions += t.contradictions;
    return *this;
  }
  nlohmann::ordered_json json() const {
    return {{"drags", drags},
            {"reached", reached},
            {"refused", refused},
            {"settings_refused", settings_refused},
            {"not_begun", not_begun},
            {"not_finite", not_finite},
            {"invalid", invalid},
            {"farther", farther},
            {"moved_though_refused", moved_though_refused},
            {"contradictions", contradictions}};
  }
};

} // namespace haptic_sculpt::robustness
