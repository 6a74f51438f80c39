// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Settings.h"

namespace haptic_sculpt::loop_program {

/// The command line. Names that were not given are empty.
struct Arguments {
  std::string mesh = HAPTIC_SCULPT_EXAMPLE_DATA "/ball_and_moon.off",
              path = HAPTIC_SCULPT_EXAMPLE_DATA "/hand_path.csv";
  std::string out, log, device, hand, record, replay, trace, report, picture, fault;
  std::optional<double> seconds;
  bool does_not_wait = false, is_real_time = false;
  Settings settings; ///< those that are options; device and hand are in files
};

/// Reads the command line. Where the program is to end now, people have been told: by what they asked for (true:
/// `--help`), or by what is wrong (false).
/// \throw Usage_error where a number cannot be used
std::optional<bool> read_arguments(int argc, char** argv, Arguments& arguments);

} // namespace haptic_sculpt::loop_program
