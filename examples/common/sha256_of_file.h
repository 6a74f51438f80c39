// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Sha256.h"
#include "contents_of.h"

#include <haptic_sculpt/surface/io/check_regular_file.h>

namespace haptic_sculpt::examples {

/// The SHA-256 of a file's bytes. \throw Read_error when it cannot be read
inline std::string sha256_of_file(const std::string& path) {
  try {
    check_regular_file(path);
  } catch (const Read_error& error) {
    throw Read_error("cannot read '" + path + "': " + error.what());
  }
  Sha256 hash;
  read_blocks<Read_error>(path, "", [&](std::string_view block) { hash.add(block); });
  return hash.digest();
}

} // namespace haptic_sculpt::examples
