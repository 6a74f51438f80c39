// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace haptic_sculpt::internal {

/// The position of the lowest bit. \pre mask != 0
inline unsigned lowest_bit(unsigned mask) {
#if defined(__GNUC__)
  return static_cast<unsigned>(__builtin_ctz(mask));
#else
  unsigned j = 0;
  while (!(mask >> j & 1))
    ++j;
  return j;
#endif
}

} // namespace haptic_sculpt::internal
