// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>

namespace haptic_sculpt {

/// An exception came in the middle of a change of the mesh, so that nobody knows what the mesh is now. The Sculptor
/// refuses every later call. What to do: make a new Sculptor of a valid mesh, of a copy made before.
///
/// Memory that runs out does not lead here: an edit asks for all it needs first. What may: a broad phase of the
/// caller's own that throws, or allocates without a `reserve()`; a property of the mesh whose values throw when they
/// are made or copied; memory that runs out, or a kept property map that throws, while a part of an undo or redo is
/// taken back.
class Unfinished_change : public Error {
public:
  Unfinished_change()
      : Error("an exception has broken off a change of the mesh, which may have holes or cross itself since: this "
              "Sculptor refuses "
              "every call; make a new one of a valid copy of the mesh") {}
};

} // namespace haptic_sculpt
