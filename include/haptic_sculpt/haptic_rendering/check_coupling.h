// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_CHECK_COUPLING_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_CHECK_COUPLING_H

#include <haptic_sculpt/haptic_rendering/Passivity_limits.h>

namespace haptic_sculpt {

/// Thrown where a coupling is neither passive nor stable on a device; says what would be.
class Unstable_coupling : public Error {
public:
  using Error::Error;
};

/// \throw Unstable_coupling
inline void check_coupling(const Virtual_coupling& coupling, const Passivity_limits& limits) {
  if (limits.permits(coupling))
    return;
  throw Unstable_coupling("the stiffness " + internal::number(coupling.stiffness) + " N/m is neither passive (up to " +
                          internal::number(std::max(0.0, limits.passive_stiffness)) + ") nor stable (up to " +
                          internal::number(std::max(0.0, limits.stable_stiffness)) +
                          ") on this device with the damping " + internal::number(coupling.damping) +
                          " N s/m; ask for less, for a higher rate or for a shorter delay");
}

} // namespace haptic_sculpt

#endif
