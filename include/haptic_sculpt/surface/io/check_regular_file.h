// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Invalid_surface.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace haptic_sculpt {

/// \throw Read_error, which says why, unless there is a regular file: a device may have no end, and a pipe has nothing
/// left for whoever reads it next
[[gnu::cold]] inline void check_regular_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    throw Read_error("there is no such file");
  if (std::filesystem::is_directory(status))
    throw Read_error("this is a directory; name a file in it");
  if (error)
    throw Read_error("this cannot be reached (" + error.message() + ")");
  if (!std::filesystem::is_regular_file(status))
    throw Read_error("this is not a regular file");
}

} // namespace haptic_sculpt
