// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

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

/// Tells the processor that these bytes will be read soon; nothing depends on it but the time.
inline void prefetch(const void* begin, std::size_t bytes) {
#if defined(__GNUC__)
  for (std::size_t k = 0; k < bytes; k += 64)
    __builtin_prefetch(static_cast<const char*>(begin) + k);
#else
  (void)begin, (void)bytes;
#endif
}

} // namespace haptic_sculpt::internal
