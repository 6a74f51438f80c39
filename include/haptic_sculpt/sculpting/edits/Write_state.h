// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Unfinished_change.h>

#include <cstdint>

namespace haptic_sculpt::internal {

/// Whether the mesh, or what is kept beside it, is being written. An exception that comes meanwhile leaves it so, for
/// good.
class Write_state {
public:
  void begin() noexcept {
    is_writing_ = true;
    ++changes_;
  }
  void end() noexcept { is_writing_ = false; }

  /// \throw Unfinished_change if a change has been begun and never ended
  void check() const {
    if (is_writing_)
      throw Unfinished_change();
  }

  /// How many changes have been begun: as long as this stays the mesh has not been written.
  std::uint64_t changes() const noexcept { return changes_; }

private:
  bool is_writing_ = false;
  std::uint64_t changes_ = 0;
};

} // namespace haptic_sculpt::internal
