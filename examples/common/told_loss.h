// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Mesh_file_format.h>
#include <haptic_sculpt/surface/vertex_attributes.h>

#include <algorithm>
#include <string>
#include <vector>

namespace haptic_sculpt::examples {

/// What OUT will be without, for people; empty where it is not asked for, or nothing is lost.
/// \param input the file that the mesh is of \param left_out what reading it has left out, as read_surface() tells
/// \param verb "is" where it is there already
template <class Mesh>
std::string told_loss(const std::string& input, const std::string& out, const Mesh& mesh,
                      std::vector<std::string> left_out, const char* verb = "will be") {
  if (const auto format = mesh_file_format(out))
    for (const std::string& word : attributes_not_held(mesh, *format))
      if (std::find(left_out.begin(), left_out.end(), word) == left_out.end())
        left_out.push_back(word);
  if (out.empty() || left_out.empty())
    return {};
  std::string listed; // e.g. "normals, colours"
  for (const std::string& word : left_out)
    listed += (listed.empty() ? "" : ", ") + word;
  return "'" + out + "' " + verb + " without what '" + input + "' has besides its faces: " + listed;
}

} // namespace haptic_sculpt::examples
