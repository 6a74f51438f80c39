// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>

namespace haptic_sculpt::examples {

/// Something that was asked for does not fit together, or cannot be used.
struct Usage_error : Error {
  using Error::Error;
};

} // namespace haptic_sculpt::examples
