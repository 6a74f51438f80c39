// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include <algorithm>

namespace haptic_sculpt::benchmark {

/// What is counted of the ends of drags.
struct End_tally {
  std::size_t drags = 0, reached = 0, asked = 0;
  std::size_t missed = 0;        ///< a free way leads nearer by more than 16 clearances
  std::size_t missed_random = 0; ///< of these, by a random way
  std::size_t gave_up = 0;       ///< nothing better was found, but the response says it gave up
  std::size_t at_leg_limit = 0, ways = 0;
  std::size_t validations = 0, invalid = 0; ///< of the mesh after the drags of one grab
  double largest_gain = 0; ///< missed, as a part of what was left
  double nanoseconds = 0, certificate_nanoseconds = 0;

  std::size_t not_reached() const { return drags - reached; }
  std::size_t misses() const { return missed + gave_up; }
  double share() const { return drags > 0 ? static_cast<double>(misses()) / static_cast<double>(drags) : 0; }

  End_tally& operator+=(const End_tally& t) {
    drags += t.drags, reached += t.reached, asked += t.asked;
    missed += t.missed, missed_random += t.missed_random, gave_up += t.gave_up;
    at_leg_limit += t.at_leg_limit, ways += t.ways;
    validations += t.validations, invalid += t.invalid;
    largest_gain = std::max(largest_gain, t.largest_gain);
    nanoseconds += t.nanoseconds, certificate_nanoseconds += t.certificate_nanoseconds;
    return *this;
  }
  nlohmann::ordered_json json() const {
    return {{"drags", drags},
            {"not_reached", not_reached()},
            {"certified", asked},
            {"missed", missed},
            {"missed_by_random_ways", missed_random},
            {"gave_up", gave_up},
            {"at_leg_limit", at_leg_limit},
            {"largest_gain_missed", largest_gain},
            {"ways", ways},
            {"validations", validations},
            {"invalid", invalid},
            {"mean_ns", drags > 0 ? nanoseconds / static_cast<double>(drags) : 0},
            {"mean_certificate_ns", drags > 0 ? certificate_nanoseconds / static_cast<double>(drags) : 0}};
  }
};

} // namespace haptic_sculpt::benchmark
