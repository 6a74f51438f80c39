// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/repair.h>

#include <string>

namespace haptic_sculpt::test {

/// How often a repair has done this, in all its rounds.
inline std::size_t count_of(const Repair_report& report, Repair_kind kind, const std::string& what) {
  std::size_t sum = 0;
  for (const auto& step : report.steps)
    if (step.kind == kind)
      for (const auto& count : step.counts)
        if (count.what == what)
          sum += count.number;
  return sum;
}

} // namespace haptic_sculpt::test
