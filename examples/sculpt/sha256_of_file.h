// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_SHA256_OF_FILE_H
#define HAPTIC_SCULPT_EXAMPLES_SHA256_OF_FILE_H

#include "Sha256.h"

#include <haptic_sculpt/surface/Invalid_surface.h>

#include <fstream>
#include <vector>

namespace haptic_sculpt::sculpt_program {

/// The SHA-256 of a file's bytes. \throw Read_error when it cannot be read
inline std::string sha256_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  Sha256 hash;
  std::vector<char> buffer(1 << 16);
  while (file.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || file.gcount() > 0)
    hash.add({buffer.data(), static_cast<std::size_t>(file.gcount())});
  if (!file.eof())
    throw Read_error("cannot read '" + path + "' to the end");
  return hash.digest();
}

} // namespace haptic_sculpt::sculpt_program

#endif
