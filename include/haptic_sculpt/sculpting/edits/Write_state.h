// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_WRITE_STATE_H
#define HAPTIC_SCULPT_SCULPTING_WRITE_STATE_H

#include <haptic_sculpt/sculpting/Unfinished_change.h>

namespace haptic_sculpt {
namespace internal {

/// Whether the mesh, or what is kept beside it, is being written. An exception that comes meanwhile leaves it so, for good.
class Write_state {
public:
  void begin() noexcept { is_writing_ = true; }
  void end() noexcept { is_writing_ = false; }

  /// \throw Unfinished_change if a change has been begun and never ended
  void check() const {
    if (is_writing_)
      throw Unfinished_change();
  }

private:
  bool is_writing_ = false;
};

} // namespace internal
} // namespace haptic_sculpt

#endif
