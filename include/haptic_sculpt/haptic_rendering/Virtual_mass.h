// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Acceleration_estimate.h>
#include <haptic_sculpt/haptic_rendering/Passivity_observer.h>
#include <haptic_sculpt/haptic_rendering/loop/require_number.h>

#include <algorithm>

namespace haptic_sculpt {

/// How heavy what is grabbed feels. Off by default: it follows an acceleration that is known by second differences, and
/// is outside of what the passive limit promises.
struct Virtual_mass_parameters {
  double mass = 0;                                       ///< kg, of what is grabbed
  double cutoff = Acceleration_estimate::default_cutoff; ///< of the acceleration, Hz; lower where encoders are coarse

  /// \throw Error naming what is wrong
  void check() const {
    internal::require_number("Virtual_mass_parameters::mass, the virtual mass,", "kg", mass, 0, 10);
    internal::require_number("Virtual_mass_parameters::cutoff, that of the acceleration,", "Hz", cutoff, 1e-3, 1e6);
  }
};

/// The force of a virtual mass, -m a, while something is grabbed. It comes and goes within `fade_time`, so that
/// grabbing in motion makes no jump.
class Virtual_mass {
public:
  static constexpr double fade_time = 0.05; ///< s

  /// \param tick s \throw Error for parameters that cannot be used
  Virtual_mass(const Virtual_mass_parameters& parameters, double tick, double delay_in_ticks)
      : mass_(parameters.mass), tick_(tick), handle_(tick, parameters.cutoff), energy_(delay_in_ticks, tick, 0, 0) {
    parameters.check();
  }

  /// Once a tick. \param step of the handle since the last tick, m \param elapsed since then, s \return the force on
  /// the hand, N. No allocation.
  Eigen::Vector3d force(const Eigen::Vector3d& step, double elapsed, bool is_grabbed) {
    if (mass_ == 0)
      return Eigen::Vector3d::Zero();
    energy_.add_step(step, 0, step);
    if (is_first_) { // no step leads to where a loop begins
      is_first_ = false;
      return Eigen::Vector3d::Zero();
    }
    share_ = std::clamp(share_ + (is_grabbed ? 1 : -1) * tick_ / fade_time, 0.0, 1.0);
    const Eigen::Vector3d force = -mass_ * share_ * handle_.add(step, elapsed);
    energy_.command(force);
    return force;
  }

  /// Forgets all steps; the mass fades in anew. The energy stays.
  void restart() {
    handle_.reset(), share_ = 0, is_first_ = true;
    energy_.command(Eigen::Vector3d::Zero());
  }

  /// What it holds at a velocity (m/s), and gives back when the hand brakes, J.
  double held_energy(const Eigen::Vector3d& velocity) const {
    return mass_ > 0 ? 0.5 * mass_ * share_ * velocity.squaredNorm() : 0;
  }
  double energy() const { return energy_.port(); } ///< taken from the hand before limits, J

private:
  double mass_, tick_, share_ = 0;
  Acceleration_estimate handle_;
  Passivity_observer energy_;
  bool is_first_ = true;
};

} // namespace haptic_sculpt
