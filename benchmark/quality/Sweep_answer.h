// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace haptic_sculpt::benchmark {

/// What every way of answering a sweep is asked for: the verdict, and the first u as a double.
struct Sweep_answer {
  bool hits = false;
  double time = 0; ///< meaningless without a hit, or where only verdicts are asked
};

} // namespace haptic_sculpt::benchmark
