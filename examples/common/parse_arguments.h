// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace haptic_sculpt::examples {

/// A check of an option that is a whole number >= 0: CLI alone takes a negative one, too, and makes it a large one.
inline std::string why_no_whole_number(const std::string& text) {
  const bool is_one = text.find_first_not_of("0123456789") == std::string::npos && text.size() < 20;
  return is_one ? "" : "'" + text + "' is not a whole number from 0 to 10^19";
}

/// Reads the command line. An empty argument is refused: it is mostly a variable that was not set, and would pass for
/// 0, or for an option that was not given. \throw CLI::ParseError
inline void parse_arguments(CLI::App& app, int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i], before = i > 1 ? argv[i - 1] : "";
    const bool is_option = argument.rfind("--", 0) == 0;
    if (argument.empty())
      throw CLI::ValidationError(before.rfind('-', 0) == 0 ? before : "argument " + std::to_string(i), "is empty");
    if (is_option && argument.find('=') == argument.size() - 1)
      throw CLI::ValidationError(argument.substr(0, argument.size() - 1), "is empty");
  }
  app.parse(argc, argv);
}

} // namespace haptic_sculpt::examples
