// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Sha256.h"

#include "../common/contents_of.h"

#include <haptic_sculpt/surface/Invalid_surface.h>

#include <filesystem>

namespace haptic_sculpt::sculpt_program {

/// The SHA-256 of a file's bytes. \throw Read_error when it cannot be read: devices have no end, a pipe is empty then
inline std::string sha256_of_file(const std::string& path) {
  std::error_code error;
  if (const auto status = std::filesystem::status(path, error);
      std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw Read_error("cannot read '" + path + "': this is not a regular file");
  Sha256 hash;
  examples::read_blocks<Read_error>(path, "", [&](std::string_view block) { hash.add(block); });
  return hash.digest();
}

} // namespace haptic_sculpt::sculpt_program
