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
  if (extension == ".off")
    return Mesh_file_format::off;
  if (extension == ".ply")
    return Mesh_file_format::ply;
  if (extension == ".obj")
    return Mesh_file_format::obj;
  if (extension == ".stl")
    return Mesh_file_format::stl;
  return std::nullopt;
}

} // namespace haptic_sculpt
