// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace haptic_sculpt::fuzz {

/// A folder of this process in the folder for temporary files.
inline const std::filesystem::path& temporary_folder() {
  struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("haptic_sculpt_fuzz_" + std::to_string(::getpid()));
    Folder() { std::filesystem::create_directory(path); }
    ~Folder() {
      std::error_code ignored; // what cannot be removed is left to the system
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder the_folder;
  return the_folder.path;
}

/// Writes a file of that name there. Returns its path.
inline std::filesystem::path temporary_file(const std::string& name, const std::uint8_t* data, std::size_t size) {
  const auto path = temporary_folder() / name;
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return path;
}

} // namespace haptic_sculpt::fuzz
