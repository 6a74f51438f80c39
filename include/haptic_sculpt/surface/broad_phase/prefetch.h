// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_PREFETCH_H
#define HAPTIC_SCULPT_SURFACE_PREFETCH_H

#include <cstddef>

namespace haptic_sculpt {
namespace internal {

/// Tells the processor that these bytes will be read soon; nothing depends on it but the time.
inline void prefetch(const void* begin, std::size_t bytes) {
#if defined(__GNUC__)
  for (std::size_t k = 0; k < bytes; k += 64)
    __builtin_prefetch(static_cast<const char*>(begin) + k);
#else
  (void)begin, (void)bytes;
#endif
}

} // namespace internal
} // namespace haptic_sculpt

#endif
