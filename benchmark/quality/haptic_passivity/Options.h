// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/Device_parameters.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace haptic_sculpt::passivity_benchmark {

using Json = nlohmann::ordered_json;

/// What is asked for on the command line.
struct Options {
  int first = 0, runs = 10, knock_runs = 20, effect_runs = 6, alarm_runs = 2, poses = 2000, prescribed = 40,
      damping_hands = 15;
  double seconds = 3, effect_seconds = 3, alarm_seconds = 60;
  std::uint64_t seed = 1;
  bool chart = false;
  std::vector<std::string> parts{"activity", "gravity", "rate",   "effects", "alarms",
                                 "dynamics", "damping", "knocks", "passive"};
  bool has(const char* part) const { return std::find(parts.begin(), parts.end(), part) != parts.end(); }
};

inline Device_form form_of(int run) {
  return run % 2 == 0 ? Device_form::ditetrahedral : Device_form::general;
}

} // namespace haptic_sculpt::passivity_benchmark
