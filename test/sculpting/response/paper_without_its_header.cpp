// SPDX-License-Identifier: GPL-3.0-or-later

#include <haptic_sculpt/sculpting/Sculptor_parameters.h>

// Refused, for nothing here says how that walk is made.
haptic_sculpt::Sculptor_parameters options() {
  return haptic_sculpt::parameters::response(haptic_sculpt::Response::paper());
}
