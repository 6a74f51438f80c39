// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oracle/Sweep_kind.h"

#include <cstdio>
#include <string>

namespace haptic_sculpt::test {

/// A query as a line that the program `sweep_queries` reads: its kind and fifteen hexadecimal doubles.
inline std::string hexadecimal(Sweep_kind kind, const Sweep_coordinates& x) {
  std::string text = sweep_name(kind);
  for (double c : x) {
    char word[32];
    std::snprintf(word, sizeof word, " %a", c);
    text += word;
  }
  return text;
}

} // namespace haptic_sculpt::test
