// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_OUTPUT_TARGETS_H
#define HAPTIC_SCULPT_EXAMPLES_OUTPUT_TARGETS_H

#include <haptic_sculpt/surface/Invalid_surface.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

#include <unistd.h>

namespace haptic_sculpt::sculpt_program {

/// Whether two names lead to one file, there or not yet there.
inline bool are_one_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error))
    return true;
  // Made absolute first: weakly_canonical leaves the name of a file that is not there yet as it is, but not ./name.
  const auto full = [](const std::filesystem::path& path) {
    std::error_code ignored; // a name that leads nowhere is told by check_target()
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored), ignored);
  };
  return full(a) == full(b);
}

/// Finds out before hours of work whether a file can be put at `path`, as far as that can be known without writing; a
/// disk may still be full in the end. \throw Write_error
inline void check_target(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  const auto fail = [&](const std::string& why) { throw Write_error("cannot write '" + path.string() + "': " + why); };
  const auto system_says = [] { return std::generic_category().message(errno); };
  std::error_code error;
  const fs::path target = fs::is_symlink(fs::symlink_status(path, error)) ? fs::weakly_canonical(path, error) : path;
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status))
    fail("this is a directory; name a file in it");
  if (fs::exists(status) && !fs::is_regular_file(status))
    fail("this is not a regular file, so it cannot be replaced");
  if (fs::exists(status) && ::access(target.c_str(), W_OK) != 0)
    fail("the file may not be written (" + system_says() + ")");
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    fail("no file can be made in its folder (" + system_says() + ")");
  if (!fs::is_directory(folder, error))
    fail("'" + folder.string() + "' is not a folder");
}

} // namespace haptic_sculpt::sculpt_program

#endif
