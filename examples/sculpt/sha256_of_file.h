// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_SHA256_OF_FILE_H
#define HAPTIC_SCULPT_EXAMPLES_SHA256_OF_FILE_H

#include <haptic_sculpt/surface/Invalid_surface.h>

#include <nettle/sha2.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace haptic_sculpt::sculpt_program {

/// The SHA-256 of a file's bytes, 64 hexadecimal digits in lower case. \throw Read_error when it cannot be read
inline std::string sha256_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  sha256_ctx context;
  sha256_init(&context);
  std::vector<char> buffer(1 << 16);
  while (file.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || file.gcount() > 0)
    sha256_update(&context, static_cast<std::size_t>(file.gcount()),
                  reinterpret_cast<const std::uint8_t*>(buffer.data()));
  if (!file.eof())
    throw Read_error("cannot read '" + path + "' to the end");
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest;
  sha256_digest(&context, digest.size(), digest.data());
  std::string text;
  for (std::uint8_t byte : digest) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

} // namespace haptic_sculpt::sculpt_program

#endif
