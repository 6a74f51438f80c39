// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_OUTPUT_TARGETS_H
#define HAPTIC_SCULPT_EXAMPLES_OUTPUT_TARGETS_H

#include <haptic_sculpt/surface/Write_error.h>
#include <haptic_sculpt/surface/io/replace_file.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace haptic_sculpt::sculpt_program {

/// Whether two names lead to one file, there or not yet there.
inline bool are_one_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error))
    return true;
  // Made absolute first: weakly_canonical leaves the name of a file that is not there yet as it is, but not ./name.
  const auto full = [](const std::filesystem::path& path) {
    std::error_code ignored; // a name that leads nowhere is told by check_target()
    try {
      return std::filesystem::weakly_canonical(std::filesystem::absolute(follow_links(path), ignored), ignored);
    } catch (const Write_error&) { // links in a circle, told there, too
      return path;
    }
  };
  return full(a) == full(b);
}

/// Finds out before hours of work whether a file can be put at `path`, as far as that can be known without writing; a
/// disk may still be full in the end. \throw Write_error
inline void check_target(const std::filesystem::path& path) {
  if (const std::string why = why_not_replaceable(follow_links(path)); !why.empty())
    throw Write_error("cannot write '" + path.string() + "': " + why);
}

} // namespace haptic_sculpt::sculpt_program

#endif
