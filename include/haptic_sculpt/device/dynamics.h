// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/planar_dynamics.h>
#include <haptic_sculpt/device/spatial_dynamics.h>

/// \file
/// Forward dynamics of the model that is asked for. No function here knows of joint friction: that is added by the
/// simulation.

namespace haptic_sculpt {

/// Which equations of motion.
enum class Dynamics_model {
  spatial, ///< spatial_dynamics(): every link moves in space
  planar   ///< planar_dynamics(): the paper's, which is false for ball elbows; to compare with
};

/// "spatial" or "planar".
inline const char* name_of(Dynamics_model model) { return model == Dynamics_model::spatial ? "spatial" : "planar"; }

/// M, C, gravity and energies of the chosen model. Failure, of the planar model only: `singular`.
template <class S>
Outcome<Dynamics_terms<S>> dynamics(const Device_parameters<S>& parameters, Dynamics_model model,
                                    const Device_motion<S>& motion) {
  return model == Dynamics_model::planar ? planar_dynamics(parameters, motion)
                                         : Outcome<Dynamics_terms<S>>(spatial_dynamics(parameters, motion));
}

/// The same, from the pose and the joint rates. Failures: `singular`, `not_finite`.
template <class S>
Outcome<Dynamics_terms<S>> dynamics(const Device_parameters<S>& parameters, Dynamics_model model,
                                    const Device_pose<S>& pose, const Device_vector<S>& rate) {
  const Outcome<Device_motion<S>> motion = device_motion(parameters, pose, rate);
  if (!motion)
    return Outcome<Dynamics_terms<S>>(motion.status(), motion.shortfall());
  const Outcome<Dynamics_terms<S>> terms = dynamics(parameters, model, *motion);
  if (terms && !internal::is_finite(terms->kinetic))
    return Outcome<Dynamics_terms<S>>(Device_status::not_finite, S(0));
  return terms;
}

/// Joint accelerations for given torques, without joint friction. Failures: `singular`, `not_finite`.
template <class S>
Outcome<Joint_accelerations<S>> forward_dynamics(const Device_parameters<S>& parameters, Dynamics_model model,
                                                 const Device_pose<S>& pose, const Device_vector<S>& rate,
                                                 const Device_vector<S>& torque) {
  if (!internal::all_finite(torque))
    return Outcome<Joint_accelerations<S>>(Device_status::not_finite, S(0));
  const Outcome<Dynamics_terms<S>> terms = dynamics(parameters, model, pose, rate);
  if (!terms)
    return Outcome<Joint_accelerations<S>>(terms.status(), terms.shortfall());
  const Joint_accelerations<S> found{terms->acceleration(rate, torque)};
  if (!internal::all_finite(found.acceleration))
    return Outcome<Joint_accelerations<S>>(terms->acceleration_failure(), S(0));
  return found;
}

} // namespace haptic_sculpt
