// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>

namespace haptic_sculpt::internal {

/// Ranges end where a number is far from any device, hand or clock: it is in another unit, or was never set.
/// \param what the member, and what that is \throw Error naming it, unless it is from `least` to `most`; NaN never is
inline void require_number(const char* what, const char* unit, double x, double least, double most) {
  if (x >= least && x <= most)
    return;
  const std::string in_unit = *unit == '\0' ? "" : ' ' + std::string(unit);
  throw Error(std::string(what) + " must be from " + number(least) + " to " + number(most) + in_unit + ", not " +
              number(x) + "; set it within that");
}

/// A tick, s, of what is of use without a chain of forces, whose own range is narrower: from 1 MHz to 1 Hz.
inline void require_tick(const char* what, double tick) {
  constexpr double shortest = 1e-6, longest = 1;
  require_number(what, "s", tick, shortest, longest);
}

/// The reach of a grab, m in the device: beside a vertex that is let go of the probe is put in parts of it, so it
/// cannot be 0.
inline void require_reach(const char* what, double reach) {
  constexpr double least = 1e-9, most = 1;
  require_number(what, "m", reach, least, most);
}

} // namespace haptic_sculpt::internal
