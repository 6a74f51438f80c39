// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_NOTE_WHAT_IS_LOST_H
#define HAPTIC_SCULPT_EXAMPLES_NOTE_WHAT_IS_LOST_H

#include "Result_writer.h"

#include <haptic_sculpt/surface/vertex_attributes.h>

#include <algorithm>
#include <string>
#include <vector>

namespace haptic_sculpt::examples {

/// Says in one line what a file had besides its points and faces, and OUT will not have; nothing where that is nothing.
/// \param lost what reading left out, in words \param mesh whose attributes OUT may not hold
template <class Mesh>
void note_what_is_lost(Result_writer& writer, const std::string& file, const std::string& out,
                       std::vector<std::string> lost, const Mesh& mesh) {
  if (const auto format = mesh_file_format(out))
    for (const std::string& word : attributes_not_held(mesh, *format))
      if (std::find(lost.begin(), lost.end(), word) == lost.end())
        lost.push_back(word);
  std::string text; // e.g. "normals, colours"
  for (const std::string& word : lost)
    text += (text.empty() ? "" : ", ") + word;
  if (!out.empty() && !text.empty())
    writer.note("'" + out + "' will be without what '" + file + "' has besides its faces: " + text);
}

} // namespace haptic_sculpt::examples

#endif
