// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>

namespace haptic_sculpt::window_program {

/// The command line. Names that were not given are empty.
struct Options {
  std::string mesh, out, log, script, screenshot, report, record;
  bool has_out = false; ///< `out` was given; else it is beside the mesh that is open
  bool without_log = false;
  bool makes_ball = false; ///< no mesh was given, and the one to begin with is not there yet
  std::array<int, 2> size = {1200, 900};
  std::optional<int> samples; ///< none: as the driver is

  /// The log of a mesh: the one that was asked for, of the first; else one beside it, which is gone when all is well.
  std::string log_of(const std::string& path) const;
  static std::string ball() { return "sculpt_window_ball.off"; }
  static std::string log_beside(const std::string& path) { return path + ".log"; }
  static std::string sculpted_beside(const std::string& path);
};

/// \throw Usage_error, Write_error where one file of the run would be written over another, or cannot be written
void check_files(const Options& options);

/// Where the program is to end now, people have been told: true for what they asked for, false for what is wrong.
std::optional<bool> read_options(int argc, char** argv, Options& options);

} // namespace haptic_sculpt::window_program
