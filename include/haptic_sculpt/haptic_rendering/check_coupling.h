// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_CHECK_COUPLING_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_CHECK_COUPLING_H

#include <haptic_sculpt/haptic_rendering/Passivity_limits.h>

namespace haptic_sculpt {

/// Thrown where a coupling is neither passive nor stable on a device; says what would be.
class Unstable_coupling : public Error {
public:
  /// Takes the whole message.
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

/// \throw Unstable_coupling for a damping, virtual mass or controller that is larger than what is stable
inline void check_dynamics(double damping, const Inertia_parameters& inertia, double controller,
                           const Passivity_limits& limits) {
  const auto check = [](const char* what, const char* unit, double asked, double largest) {
    if (asked > largest)
      throw Unstable_coupling("the " + std::string(what) + ' ' + internal::number(asked) + ' ' + unit +
                              " is not stable on this device; the largest that serves at this rate and delay is " +
                              internal::number(largest) + ' ' + unit);
  };
  check("damping", "N s/m", damping, limits.largest_damping);
  check("virtual mass", "kg", inertia.mass, limits.largest_mass);
  check("damping of the passivity controller", "N s/m", controller, limits.largest_controller);
}

} // namespace haptic_sculpt

#endif
