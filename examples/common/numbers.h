// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <string>

/// \file
/// Numbers as scripts and options give them: decimal or C99 hexadecimal.

namespace haptic_sculpt::examples {

/// The whole word as a number, which may be infinite or none; nothing where it is no number.
inline std::optional<double> number_of(const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  const bool is_blank = word.empty() || std::isspace(static_cast<unsigned char>(word[0])); // which strtod passes over
  return !is_blank && end == word.c_str() + word.size() ? std::optional(value) : std::nullopt;
}

/// The shortest decimal that is this number.
inline std::string decimal(double x) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

/// The three words of `@X,Y,Z`; nothing where there are not three.
inline std::optional<std::array<std::string, 3>> words_of_place(const std::string& text) {
  std::array<std::string, 3> words;
  if (text.empty() || text[0] != '@')
    return std::nullopt;
  std::size_t begin = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t comma = text.find(',', begin);
    if ((comma == std::string::npos) != (i == 2))
      return std::nullopt;
    words[i] = text.substr(begin, comma - begin);
    begin = comma + 1;
  }
  return words;
}

/// The place that `@X,Y,Z` names, whose coordinates may be infinite or none; nothing where it is no such text.
inline std::optional<std::array<double, 3>> place_of(const std::string& text) {
  const auto words = words_of_place(text);
  std::array<double, 3> place{};
  for (std::size_t i = 0; words && i < 3; ++i)
    if (const auto value = number_of((*words)[i]))
      place[i] = *value;
    else
      return std::nullopt;
  return words ? std::optional(place) : std::nullopt;
}

} // namespace haptic_sculpt::examples
