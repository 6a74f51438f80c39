// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/io/quoted.h>

#include <algorithm>
#include <initializer_list>
#include <string>

namespace haptic_sculpt::internal {

/// Whether a file of words can name a property so.
inline bool is_single_word(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) { return c > ' ' && c != 0x7f; });
}

/// What is lost with a property of a PLY file, for people.
inline std::string attribute_in_words(const std::string& name) {
  const auto is_one_of = [&](std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (is_one_of({"nx", "ny", "nz"}))
    return "normals";
  if (is_one_of({"red", "green", "blue", "diffuse_red", "diffuse_green", "diffuse_blue"}))
    return "colours";
  if (name == "alpha")
    return "opacity"; // of colours: OBJ holds these without it
  if (is_one_of({"s", "t", "u", "v", "texture_u", "texture_v", "texcoord", "texnumber"}))
    return "texture coordinates";
  return "the property " + in_quotes(name);
}

} // namespace haptic_sculpt::internal
