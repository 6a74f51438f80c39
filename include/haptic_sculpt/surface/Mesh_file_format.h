// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace haptic_sculpt {

/// The formats that are read and written. What each can hold write_surface() says.
enum class Mesh_file_format {
  off, ///< text
  ply, ///< text or binary
  obj, ///< text
  stl  ///< text or binary
};

/// "off", "ply", "obj" or "stl": the extension without its dot.
inline const char* name_of(Mesh_file_format format) {
  constexpr const char* names[] = {"off", "ply", "obj", "stl"};
  return names[static_cast<int>(format)];
}

/// The format that the extension of a path names, in upper or lower case.
inline std::optional<Mesh_file_format> mesh_file_format(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z')
      c = static_cast<char>(c - 'A' + 'a');
  for (const auto format : {Mesh_file_format::off, Mesh_file_format::ply, Mesh_file_format::obj, Mesh_file_format::stl})
    if (extension == std::string(".") + name_of(format))
      return format;
  return std::nullopt;
}

} // namespace haptic_sculpt
