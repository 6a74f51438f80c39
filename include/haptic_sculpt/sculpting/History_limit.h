// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>

namespace haptic_sculpt {

/// How much is kept for undo and redo together. Where there is more, the oldest steps are forgotten, each as a whole. A
/// step is recorded before it is forgotten, and the room that it took stays for others.
struct History_limit {
  std::size_t steps = std::numeric_limits<std::size_t>::max(); ///< at first without limit
  std::size_t bytes = std::numeric_limits<std::size_t>::max(); ///< at first without limit; a drag alone takes 72

  static History_limit none() { return {}; } ///< everything is kept
  /// Nothing is kept.
  static History_limit off() { return {0, 0}; }
};

} // namespace haptic_sculpt
