// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_INERTIA_RENDERING_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_INERTIA_RENDERING_H

#include <haptic_sculpt/device/spatial_dynamics.h>
#include <haptic_sculpt/haptic_rendering/Acceleration_estimate.h>
#include <haptic_sculpt/haptic_rendering/Handle_motion.h>
#include <haptic_sculpt/haptic_rendering/Passivity_observer.h>

namespace haptic_sculpt {

/// How heavy things feel. Both are off by default: they follow an acceleration that is told by second differences, and
/// are outside of what the passive limit promises.
struct Inertia_parameters {
  double mass = 0;        ///< kg, of what is grabbed
  double compensated = 0; ///< the share, 0 to 1, of the mechanism's own inertia that motors carry
  double cutoff = Acceleration_estimate::default_cutoff; ///< of the acceleration, Hz; lower where encoders are coarse

  bool is_on() const { return mass != 0 || compensated != 0; } ///< whether any force comes of it
  /// \throw Error naming what is wrong
  void check() const {
    if (!(mass >= 0 && mass <= 10))
      throw Error("the virtual mass must be from 0 to 10 kg, not " + internal::number(mass));
    if (!(compensated >= 0 && compensated <= 1))
      throw Error("the share of the inertia that is compensated must be from 0 to 1, not " +
                  internal::number(compensated));
    if (!(cutoff > 0 && std::isfinite(cutoff)))
      throw Error("the cutoff of the acceleration must be a frequency, not " + internal::number(cutoff) + " Hz");
  }
};

/// The force of a virtual mass, -m a, while something is grabbed, and the force that carries a share of the mechanism's
/// inertia. The mass comes and goes within `fade_time`, so that grabbing in motion makes no jump.
class Inertia_rendering {
public:
  static constexpr double fade_time = 0.05; ///< s

  /// \throw Error for parameters that cannot be used
  Inertia_rendering(const Inertia_parameters& parameters, const Device_parameters<double>& device, double tick,
                    double delay_in_ticks)
      : parameters_(parameters)
      , weightless_(weightless(device))
      , tick_(tick)
      , handle_(tick, parameters.cutoff)
      , joints_(tick, parameters.cutoff)
      , mass_energy_(delay_in_ticks, tick, 0, 0)
      , compensation_energy_(delay_in_ticks, tick, 0, 0) {
    parameters.check();
  }

  /// Once a tick, after the handle has followed. \return the force on the hand, N. No allocation.
  Eigen::Vector3d force(const Handle_motion& handle, bool is_grabbed) {
    if (!parameters_.is_on())
      return Eigen::Vector3d::Zero();
    mass_energy_.add_step(handle.joint_step(), 0, handle.step());
    compensation_energy_.add_step(handle.joint_step(), 0, handle.step());
    if (!handle.has_step()) {
      restart();
      return Eigen::Vector3d::Zero();
    }
    const Eigen::Vector3d acceleration = handle_.add(handle.step());
    const Eigen::Vector3d joint_acceleration = joints_.add(handle.joint_step());
    share_ = std::clamp(share_ + (is_grabbed ? 1 : -1) * tick_ / fade_time, 0.0, 1.0);
    const Eigen::Vector3d mass = -parameters_.mass * share_ * acceleration;
    const Eigen::Matrix3d& linear = handle.jacobian().linear;
    Eigen::Vector3d carried = Eigen::Vector3d::Zero();
    if (parameters_.compensated > 0)
      if (const auto torque = spatial_inverse_dynamics(
              weightless_, handle.pose(), Device_vector<double>(handle.joint_step() / tick_), joint_acceleration))
        carried = parameters_.compensated * linear.transpose().partialPivLu().solve(torque->torque);
    mass_energy_.command(linear.transpose() * mass);
    compensation_energy_.command(linear.transpose() * carried);
    return mass + carried;
  }

  /// Forgets all steps; a mass fades in anew. The energies stay.
  void restart() {
    handle_.reset(), joints_.reset(), share_ = 0;
    mass_energy_.command(Eigen::Vector3d::Zero()), compensation_energy_.command(Eigen::Vector3d::Zero());
  }

  /// \name What was taken from the hand before limits, J
  ///@{
  double mass_energy() const { return mass_energy_.port(); }                 ///< by the virtual mass
  double compensation_energy() const { return compensation_energy_.port(); } ///< by carrying the mechanism's inertia
  ///@}

private:
  Inertia_parameters parameters_;
  Device_parameters<double> weightless_;
  double tick_, share_ = 0;
  Acceleration_estimate handle_, joints_;
  Passivity_observer mass_energy_, compensation_energy_;

  static Device_parameters<double> weightless(const Device_parameters<double>& device) {
    Device_description<double> description = device.description();
    description.gravity = 0;
    return Device_parameters<double>(description);
  }
};

} // namespace haptic_sculpt

#endif
