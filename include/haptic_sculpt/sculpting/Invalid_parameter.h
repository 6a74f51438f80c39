// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>

namespace haptic_sculpt {

/// A parameter outside of its range, e.g. a negative clearance.
class Invalid_parameter : public Error {
public:
  /// Takes the whole message.
  using Error::Error;
};

} // namespace haptic_sculpt
