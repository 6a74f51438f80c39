// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace haptic_sculpt::benchmark {

/// By what sweeps are decided: determinants in doubles or long doubles, the paper's equations with an epsilon, the
/// exact traits of the library, or the rational oracle of the tests.
enum class Arithmetic { doubles, paper, long_doubles, exact, rationals };

/// As it is called in reports.
inline const char* name_of(Arithmetic arithmetic) {
  constexpr const char* names[] = {"double", "paper, epsilon 1e-9", "long double", "haptic_sculpt, exact",
                                   "GMP rationals"};
  return names[static_cast<int>(arithmetic)];
}

} // namespace haptic_sculpt::benchmark
