// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>

namespace haptic_sculpt {

/// A function that was given to a call, of progress for instance, wants to change the mesh or its Sculptor while that
/// call is under way. Nothing has been changed by it. What to do: return, and edit after the call. To look is allowed.
class Reentrant_call : public Error {
public:
  Reentrant_call()
      : Error("a function given to a call of this Sculptor (progress, a property map, a policy) may not change "
              "anything while that call is under way: let it return, false where the call is to end, and edit "
              "afterwards") {}
};

} // namespace haptic_sculpt
