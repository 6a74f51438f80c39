// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "numbers.h"

#include <CLI/CLI.hpp>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

namespace haptic_sculpt::examples {

/// Writes a whole number as CLI reads it rightly: CLI alone takes 010 for 8, -1 for 2^64 - 1, and what is too large for
/// the largest. \return why it is none; empty if it is one
template <class Number>
std::string normalise_whole_number(std::string& text) {
  Number number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end)
    return "'" + text + "' is not a whole number from " + std::to_string(std::numeric_limits<Number>::min()) + " to " +
           std::to_string(std::numeric_limits<Number>::max());
  text = std::to_string(number);
  return "";
}

/// Writes a number as CLI reads it rightly: CLI rounds it twice, at first to a long double.
inline std::string normalise_number(std::string& text) {
  const auto number = number_of(text);
  if (number && std::isfinite(*number) && static_cast<double>(std::strtold(text.c_str(), nullptr)) != *number) {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.17g", *number);
    text = digits;
  }
  return "";
}

/// In the line of usage what has no name comes first: behind an option with a list it would be taken for more of that.
struct Arguments_first : CLI::Formatter {
  std::string make_usage(const CLI::App* app, std::string name) const override {
    const std::string options = " [OPTIONS]", usage = Formatter::make_usage(app, std::move(name));
    const std::size_t at = usage.find(options), end = usage.find_last_not_of('\n') + 1;
    if (at == std::string::npos)
      return usage;
    const std::size_t behind = at + options.size();
    return usage.substr(0, at) + usage.substr(behind, end - behind) + options + usage.substr(end);
  }
};

/// Refuses the name of an option as the value of another one: `--report --log FILE` lacks a value.
inline CLI::Validator no_option_of(const CLI::App& app) {
  return CLI::Validator(
      [&app](const std::string& text) -> std::string {
        const std::string name = text.rfind("--", 0) == 0 ? text.substr(0, text.find('=')) : text.substr(0, 2);
        if (text.rfind('-', 0) != 0 || app.get_option_no_throw(name) == nullptr)
          return "";
        return "lacks its value: '" + text + "' is an option. What has such a name is given as ./" + text;
      },
      "");
}

/// Reads the command line. Whole numbers are decimal, whatever zeros they begin with. An empty argument is refused: it
/// is mostly a variable that was not set, and would pass for 0, or for an option that was not given.
/// \throw CLI::ParseError
inline void parse_arguments(CLI::App& app, int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i], before = i > 1 ? argv[i - 1] : "";
    const bool is_option = argument.rfind("--", 0) == 0;
    if (argument.empty())
      throw CLI::ValidationError(before.rfind('-', 0) == 0 ? before : "argument " + std::to_string(i), "is empty");
    if (is_option && argument.find('=') == argument.size() - 1)
      throw CLI::ValidationError(argument.substr(0, argument.size() - 1), "is empty");
  }
  for (CLI::Option* const option : app.get_options()) {
    const std::string type = option->get_type_name(); // its checks come after it
    if (type.rfind("UINT", 0) == 0)
      option->transform(CLI::Validator(normalise_whole_number<std::uint64_t>, ""));
    else if (type.rfind("INT", 0) == 0)
      option->transform(CLI::Validator(normalise_whole_number<std::int64_t>, ""));
    else if (type.rfind("FLOAT", 0) == 0 || type.rfind("X Y Z", 0) == 0) // three of them
      option->transform(CLI::Validator(normalise_number, ""));
    if (option->nonpositional() && option->get_items_expected_max() > 0)
      option->transform(no_option_of(app)); // looked at first
  }
  app.formatter(std::make_shared<Arguments_first>());
  app.parse(argc, argv);
}

} // namespace haptic_sculpt::examples
