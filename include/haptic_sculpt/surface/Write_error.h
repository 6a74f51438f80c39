// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>

namespace haptic_sculpt {

/// A file could not be written. What was there before, if anything, is as it was.
class Write_error : public Error {
public:
  using Error::Error; ///< takes the message that `what()` gives
};

} // namespace haptic_sculpt
