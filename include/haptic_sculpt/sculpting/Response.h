// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace haptic_sculpt {

/// What a vertex does when its way is blocked.
enum class Response : std::uint8_t {
  slide, ///< it slides on, to a point nearest to its target that the contacts permit
  stop,  ///< it stays where it was stopped
  paper  ///< it walks by the rules of the 1997 paper; kept to be compared with
};

/// The name used in scripts: "slide", "stop" or "paper".
inline const char* name_of(Response rule) {
  constexpr const char* names[] = {"slide", "stop", "paper"};
  return names[static_cast<int>(rule)];
}

/// The response of that name, or nothing.
inline std::optional<Response> response_named(const std::string& name) {
  for (const Response rule : {Response::slide, Response::stop, Response::paper})
    if (name == name_of(rule))
      return rule;
  return std::nullopt;
}

} // namespace haptic_sculpt
