// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>

#include <cstddef>
#include <string>

namespace haptic_sculpt {

/// A vertex descriptor that is not a vertex of the mesh was given.
class Unknown_vertex : public Error {
public:
  /// Names the index of the vertex.
  explicit Unknown_vertex(std::size_t index)
      : Error("vertex " + std::to_string(index) +
              " is not in the mesh, or was removed: give a vertex of mesh.vertices()") {}
};

} // namespace haptic_sculpt
