// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace haptic_sculpt::examples {

/// What a message may quote of a file: cut to 60 bytes, control bytes written as \x1b, for a terminal obeys them.
inline std::string printable(std::string_view bytes) {
  constexpr std::size_t most = 60;
  std::string text;
  for (const unsigned char byte : bytes.substr(0, most)) {
    if (byte >= 0x20 && byte != 0x7f) {
      text += static_cast<char>(byte);
      continue;
    }
    char escaped[5];
    std::snprintf(escaped, sizeof escaped, "\\x%02x", byte);
    text += escaped;
  }
  return bytes.size() > most ? text + "..." : text;
}

} // namespace haptic_sculpt::examples
