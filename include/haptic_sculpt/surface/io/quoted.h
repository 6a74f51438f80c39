// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace haptic_sculpt::internal {

inline void append_escaped(std::string& out, unsigned char byte) {
  constexpr char digits[] = "0123456789abcdef";
  out += "\\x";
  out += digits[byte >> 4];
  out += digits[byte & 15];
}

/// Bytes of a file, as an error message may show them: cut after `most` bytes; a byte that is no printable ASCII
/// character stands as \xNN. So no file can give orders to a terminal, or break a line of a log.
inline std::string escaped(std::string_view bytes, std::size_t most = 40) {
  std::string out;
  for (const char c : bytes.substr(0, most))
    if (c < ' ' || c > '~')
      append_escaped(out, static_cast<unsigned char>(c));
    else if (c == '\\')
      out += "\\\\";
    else
      out += c;
  return bytes.size() > most ? out + "..." : out;
}

/// The same between quotation marks.
inline std::string in_quotes(std::string_view bytes, std::size_t most = 40) {
  return "'" + escaped(bytes, most) + "'";
}

/// The length of the UTF-8 sequence at the front that makes one printable character; 0 if there is none.
inline std::size_t printable_sequence(std::string_view bytes) {
  const auto at = [&](std::size_t i) { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u; };
  const unsigned lead = at(0);
  if (lead < 0x80)
    return lead >= ' ' && lead != 0x7f ? 1 : 0;
  const std::size_t length = lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : lead < 0xf5 ? 4 : 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((at(i) & 0xc0) != 0x80)
      return 0;
  // Not: control characters U+0080 to U+009F, overlong forms, surrogates, beyond U+10FFFF.
  const bool bad = (lead == 0xc2 && at(1) < 0xa0) || (lead == 0xe0 && at(1) < 0xa0) ||
                   (lead == 0xed && at(1) >= 0xa0) || (lead == 0xf0 && at(1) < 0x90) || (lead == 0xf4 && at(1) >= 0x90);
  return bad ? 0 : length;
}

/// The name of a file, as an error message may show it: whole, between quotation marks; control characters and what is
/// no UTF-8 stand as \xNN.
inline std::string quoted_path(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::string out = "'";
  for (std::size_t i = 0; i < name.size();)
    if (const std::size_t length = printable_sequence(std::string_view(name).substr(i)); length > 0) {
      out.append(name, i, length);
      i += length;
    } else {
      append_escaped(out, static_cast<unsigned char>(name[i++]));
    }
  return out + "'";
}

} // namespace haptic_sculpt::internal
