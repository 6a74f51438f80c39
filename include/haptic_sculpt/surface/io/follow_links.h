// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Write_error.h>

#include <filesystem>
#include <system_error>

namespace haptic_sculpt {
namespace internal {

inline std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

} // namespace internal

/// Where a file that is written at `path` comes to lie: the end of the chain of symbolic links that begins there,
/// whether or not something is there yet. \throw Write_error if the links lead in a circle
inline std::filesystem::path follow_links(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  constexpr int most = 40; // as many as Linux follows
  fs::path at = path;
  std::error_code error;
  for (int link = 0; fs::is_symlink(fs::symlink_status(at, error)); ++link) {
    if (fs::is_other(fs::status(at, error))) // a device or a pipe: links such as /dev/stdout do not say where they lead
      return at;
    const fs::path next = fs::read_symlink(at, error);
    if (error || link == most)
      throw Write_error("cannot write '" + path.string() + "': " +
                        (error ? "the symbolic link cannot be read (" + error.message() + ")"
                               : "its symbolic links lead in a circle, or are more than " + std::to_string(most)));
    at = at.parent_path() / next; // an absolute path takes the place of both
  }
  return at;
}

} // namespace haptic_sculpt
