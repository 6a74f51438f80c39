// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/test/unit_test.hpp>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace haptic_sculpt::test {

/// A file or folder of the data that are no part of a clone, in the folder that the environment variable
/// HAPTIC_SCULPT_SHARED names. Nothing, with a line that test/run repeats at its end, where the variable is not set; a
/// failure where it is set and the file is not there.
inline std::optional<std::filesystem::path> shared_data(const std::string& name) {
  const char* const folder = std::getenv("HAPTIC_SCULPT_SHARED");
  if (folder == nullptr || *folder == 0) {
    BOOST_TEST_MESSAGE("skipped: " << name << " is read only where HAPTIC_SCULPT_SHARED names its folder");
    return std::nullopt;
  }
  const std::filesystem::path path = std::filesystem::path(folder) / name;
  BOOST_TEST_REQUIRE(std::filesystem::exists(path), "HAPTIC_SCULPT_SHARED: there is no " << path);
  return path;
}

} // namespace haptic_sculpt::test
