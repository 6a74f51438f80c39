// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>

namespace haptic_sculpt {

/// The mesh was changed by somebody else than the Sculptor that guards it. What to do: undo the change, or make a new
/// Sculptor, which validates the mesh anew.
class Mesh_changed : public Error {
public:
  /// \param what was changed; the message says what to do as well
  explicit Mesh_changed(const std::string& what)
    : Error("the mesh was changed behind the Sculptor's back: " + what +
            "; undo that change, or make a new Sculptor of the mesh") {}
};

} // namespace haptic_sculpt
