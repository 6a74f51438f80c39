// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Haptic_parameters.h>
#include <haptic_sculpt/haptic_rendering/Passivity_limits.h>

namespace haptic_sculpt {

/// Thrown where a coupling is not passive or not calm on a device, or something else too strong for it; says what would
/// serve.
class Unstable_coupling : public Error {
public:
  /// Takes the whole message.
  using Error::Error;
};

/// \param of_snap how much of the stiffness is a snap's, N/m \throw Unstable_coupling
inline void check_coupling(const Virtual_coupling& coupling, const Passivity_limits& limits, double of_snap = 0) {
  if (limits.permits(coupling))
    return;
  const bool is_passive = limits.largest_stiffness() < limits.passive_stiffness; // up to where it is calm
  const std::string snap =
      of_snap > 0 ? ", of which the snap has " + internal::number(of_snap) + " (2 force / length)," : "";
  throw Unstable_coupling("the stiffness " + internal::number(coupling.stiffness) + " N/m" + snap + " is not " +
                          (is_passive ? "calm" : "passive") + " on this device with the damping " +
                          internal::number(coupling.damping) + " N s/m: that ends at " +
                          internal::number(limits.largest_stiffness()) + "; ask for less, for " +
                          (coupling.damping > 0 ? "a smaller damping, for " : "") +
                          (is_passive ? "finer encoders" : "a higher rate or for a shorter delay"));
}

/// \throw Unstable_coupling for a damping, virtual mass or controller that is larger than what serves
inline void check_dynamics(double damping, double virtual_mass, double controller,
                           const Passivity_limits& limits) {
  const auto check = [](const char* what, const char* unit, double asked, double largest, bool is_friction = false) {
    if (!(asked <= largest))
      throw Unstable_coupling("the " + std::string(what) + ' ' + internal::number(asked) + ' ' + unit +
                              " is not stable on this device; the largest that serves " +
                              (is_friction ? "is its friction at the handle, " : "at this rate and delay is ") +
                              internal::number(largest) + ' ' + unit);
  };
  check("damping", "N s/m", damping, limits.largest_damping, limits.largest_damping == limits.friction);
  check("virtual mass", "kg", virtual_mass, limits.largest_mass);
  check("damping of the passivity controller", "N s/m", controller, limits.largest_controller);
}

/// All of the above. \throw Unstable_coupling
inline void check_forces(const Haptic_parameters& parameters, const Passivity_limits& limits) {
  check_dynamics(parameters.coupling.damping, parameters.virtual_mass.mass, parameters.controller_damping.value_or(0),
                 limits);
  check_coupling(parameters.stiffest(), limits, parameters.snap.stiffness());
}

/// The same for a device of joints. \throw Unstable_coupling; Error for limits made for another device, map,
/// tick, delay, damping, cutoff or fading
inline void check_limits(const Passivity_limits& limits, const Device_parameters<double>& device,
                         const Workspace_map& map, const Haptic_parameters& parameters) {
  parameters.check();
  if (!limits.are_for(device, parameters.limits, map, parameters.coupling.damping, parameters.tick, parameters.delay,
                      parameters.virtual_mass.cutoff))
    throw Error("the limits of passivity were made for another device, map, tick, delay, damping, cutoff or fading of "
                "the force; make them anew with passivity_limits()");
  check_forces(parameters, limits);
}

} // namespace haptic_sculpt
