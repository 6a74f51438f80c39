// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace haptic_sculpt::benchmark {

/// By what sweeps are decided: determinants in doubles or long doubles, the paper's equations with an epsilon, or
/// the exact traits of the library.
enum class Arithmetic { doubles, paper, long_doubles, exact };

/// As it is called in reports.
inline const char* name_of(Arithmetic arithmetic) {
  constexpr const char* names[] = {"double", "paper, epsilon 1e-9", "long double", "haptic_sculpt, exact"};
  return names[static_cast<int>(arithmetic)];
}

} // namespace haptic_sculpt::benchmark
