// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace haptic_sculpt::examples {

/// What is wrong with a JSON, for people: where it is, and what, without the names of the library that reads it.
/// E.g. "line 3, column 7: unexpected ','; expected value". Of what stands there at most some hundred bytes.
/// \param line number of the text's line, where it is one line of a file
inline std::string in_words(const nlohmann::json::exception& error, std::size_t line = 1) {
  std::string text = error.what();
  if (const std::size_t end = text.find("] "); text.substr(0, 1) == "[" && end != std::string::npos)
    text.erase(0, end + 2); // [json.exception.parse_error.101]
  for (const std::string begin : {"parse error at ", "parse error: "})
    if (text.compare(0, begin.size(), begin) == 0)
      text.erase(0, begin.size());
  const std::string syntax = "syntax error while parsing ";
  if (const std::size_t at = text.find(syntax); at != std::string::npos)
    if (const std::size_t dash = text.find(" - ", at); dash != std::string::npos)
      text.erase(at, dash + 3 - at);
  if (const std::string first = "line 1,"; text.compare(0, first.size(), first) == 0)
    text.replace(0, first.size(), "line " + std::to_string(line) + ",");
  constexpr std::size_t most = 400;
  return text.size() <= most ? text : text.substr(0, most) + "...";
}

/// As text that is UTF-8 whatever strings it was given: names of files may be any bytes.
template <class Json>
std::string text_of(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace haptic_sculpt::examples
