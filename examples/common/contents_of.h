// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

namespace haptic_sculpt::examples {

/// Hands what is left of an open file to `take`, block by block. \param named as messages call it \throw Exception
template <class Exception, class Take>
void read_to_end(int file, const std::string& named, const Take& take) {
  std::array<char, 1 << 16> block;
  for (;;) {
    const ssize_t got = ::read(file, block.data(), block.size());
    if (got == 0)
      return;
    if (got > 0)
      take(std::string_view(block.data(), static_cast<std::size_t>(got)));
    else if (errno != EINTR)
      throw Exception("reading " + named + " failed: " + std::strerror(errno));
  }
}

/// How messages call a file. \param what it is, e.g. "the script"; may be empty
inline std::string name_in_message(const std::string& path, const std::string& what) {
  return what + (what.empty() ? "'" : " '") + path + "'";
}

/// The same of a file by its name; a pipe, too. Of standard input it is what is left, and it may be a socket: opened
/// anew, a file begins at its beginning, and a socket not at all. \param what how messages call it \throw Exception,
/// which says why it cannot be read: not there, a folder, no permission
template <class Exception, class Take>
void read_blocks(const std::string& path, const std::string& what, const Take& take) {
  const std::string name = name_in_message(path, what);
  const int opened =
      path == "/dev/stdin" ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0)
    throw Exception("cannot open " + name + ": " + std::strerror(errno));
  const auto close = [](const int* file) { ::close(*file); };
  const std::unique_ptr<const int, decltype(close)> closes(&opened, close);
  read_to_end<Exception>(opened, name, take);
}

/// All of a file. \param most_mebibytes that it may have: an endless one does not use up the memory
/// \throw Exception, also where it is longer
template <class Exception>
std::string contents_of(const std::string& path, const std::string& what, std::size_t most_mebibytes = 1024) {
  std::string text;
  read_blocks<Exception>(path, what, [&](std::string_view block) {
    if (block.size() > (most_mebibytes << 20) - text.size())
      throw Exception(name_in_message(path, what) + " is longer than " + std::to_string(most_mebibytes) + " MiB");
    text += block;
  });
  return text;
}

/// Without the byte order mark that some editors put before a text.
inline std::string_view without_byte_order_mark(std::string_view text) {
  return text.substr(text.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0);
}

} // namespace haptic_sculpt::examples
