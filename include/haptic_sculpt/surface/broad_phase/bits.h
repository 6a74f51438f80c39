// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_BITS_H
#define HAPTIC_SCULPT_SURFACE_BITS_H

namespace haptic_sculpt {
namespace internal {

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

} // namespace internal
} // namespace haptic_sculpt

#endif
