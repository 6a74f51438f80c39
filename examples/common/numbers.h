// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_NUMBERS_H
#define HAPTIC_SCULPT_EXAMPLES_NUMBERS_H

#include <array>
#include <cctype>
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
  const bool is_number = !word.empty() && !std::isspace(static_cast<unsigned char>(word[0])) && end == word.c_str() + word.size();
  return is_number ? std::optional(value) : std::nullopt;
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

#endif
