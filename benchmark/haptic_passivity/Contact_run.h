// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_BENCHMARK_CONTACT_RUN_H
#define HAPTIC_SCULPT_BENCHMARK_CONTACT_RUN_H

#include <haptic_sculpt/haptic_rendering/Force_renderer.h>
#include <haptic_sculpt/haptic_rendering/Inertia_rendering.h>
#include <haptic_sculpt/haptic_rendering/Passivity_controller.h>
#include <haptic_sculpt/haptic_rendering/simulation/Simulated_device.h>
#include <haptic_sculpt/haptic_rendering/Virtual_coupling.h>
#include <haptic_sculpt/haptic_rendering/Watchdog.h>

namespace haptic_sculpt::passivity_benchmark {

/// A mechanism in a hand beside a plane: what a run is made of. The plane stands for a surface that answers exactly,
/// so that a simulated second costs the mechanism and not the mesh.
struct Contact_setup {
  Device_parameters<double> device; ///< its friction, encoders and torque limit count
  Device_pose<double> start;
  Eigen::Vector3d on_plane, normal; ///< m; the handle begins where the normal points
  Hand_path path;
  Simulated_hand hand;
  double tick = 0.001, delay = 0; ///< s, ticks
  Virtual_coupling coupling{};
  double greatest = 0;        ///< sigma_max(J), m/rad, for which the coupling was chosen; a run ends beyond
  double most_condition = 10; ///< cond(J) beyond which it ends too
  Force_limits limits{};
  Inertia_parameters inertia{};
  double controller_damping = 0; ///< N s/m
  double burst_every = 0;        ///< s; 0: no edits are refused
};

/// Nothing between the wanted force and the motors.
inline Force_limits no_limits() {
  Force_limits limits{};
  limits.slew = limits.largest = 1e9, limits.ramp_time = 1e-9;
  limits.full_condition = limits.no_condition = 1e9;
  return limits;
}

/// Energies in J.
struct Contact_outcome {
  double contact = 0, time = 0; ///< s
  std::size_t ticks = 0;        ///< in contact
  double least = 0;             ///< of the port's true energy plus physical dissipation, at any tick
  double least_port = 0;        ///< of the port's alone
  double largest_port = 0;      ///< magnitude
  double observer_error = 0;    ///< the observer's port against the true one, at most
  double least_observed = 0;    ///< of the observer's energy with its credit, plus the dissipation that it sees
  double inertia_energy = 0;    ///< taken from the hand by virtual mass and compensation, before limits
  double largest_force = 0;     ///< N, rendered
  double limited = 0;           ///< share of the ticks in which limits changed the force
  bool has_left = false;        ///< the poses for which the coupling was chosen
  Loop_fault fault = Loop_fault::none;
};

/// Until `seconds` of contact have been, or three times as long has passed.
/// \param each called after every tick with the handle; returns false to end
template <class Each>
Contact_outcome run_contact(const Contact_setup& setup, double seconds, const Each& each) {
  const Device_parameters<double>& device = setup.device;
  Simulated_device simulated(device, setup.start, setup.hand, setup.path, setup.tick, setup.delay);
  Handle_motion handle(device, setup.start, setup.tick);
  Force_renderer renderer(setup.limits, Gravity_compensation::spatial, setup.tick);
  Inertia_rendering inertia(setup.inertia, device, setup.tick, setup.delay);
  Passivity_observer observer(setup.delay, setup.tick, device.viscous_friction(), device.encoder_step());
  Passivity_controller controller(setup.controller_damping, setup.tick);
  Watchdog watchdog(Watchdog_limits(), setup.tick, device.torque_limit());
  Contact_span span;
  span.add(setup.normal);
  Contact_outcome outcome;
  double next_burst = setup.burst_every, limited = 0;
  while (outcome.contact < seconds && outcome.time < 3 * seconds) {
    const Joint_reading reading = simulated.read();
    if (!watchdog.check(reading) || !watchdog.check_condition(handle.follow(reading.theta)))
      break;
    const auto conditioning = translation_conditioning(handle.jacobian());
    outcome.has_left = conditioning.greatest > setup.greatest || conditioning.condition > setup.most_condition;
    if (outcome.has_left)
      break;
    observer.add_step(handle.joint_step(), setup.coupling.stiffness, handle.step());
    outcome.observer_error = std::fmax(outcome.observer_error, std::abs(observer.port() - simulated.port()));
    const double depth = -setup.normal.dot(handle.position() - setup.on_plane);
    const bool reached = depth <= 0;
    const Eigen::Vector3d spring =
        reached ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(setup.coupling.stiffness * depth * setup.normal);
    if (setup.burst_every > 0 && outcome.time >= next_burst)
      renderer.refuse(handle, setup.normal), next_burst += setup.burst_every;
    const Eigen::Vector3d wanted = spring + setup.coupling.damping_force(span, handle.velocity(), reached) +
                                   inertia.force(handle, true) + controller.force(observer, handle);
    const Rendered_force rendered = renderer.render(handle, wanted);
    limited += (rendered.force - wanted).norm() > 1e-9 * (1 + wanted.norm());
    observer.command(rendered.interaction_torque);
    if (simulated.write(rendered.torque, rendered.interaction_torque) != Device_status::success) {
      outcome.has_left = true;
      break;
    }
    outcome.time = simulated.time();
    outcome.ticks += !reached, outcome.contact += reached ? 0 : setup.tick;
    outcome.least = std::fmin(outcome.least, simulated.port() + simulated.dissipated());
    outcome.least_port = std::fmin(outcome.least_port, simulated.port());
    outcome.largest_port = std::fmax(outcome.largest_port, std::abs(simulated.port()));
    outcome.largest_force = std::fmax(outcome.largest_force, rendered.force.norm());
    if (!each(simulated, handle, rendered))
      break;
  }
  outcome.least_observed = observer.least();
  outcome.inertia_energy = inertia.mass_energy() + inertia.compensation_energy();
  outcome.limited = limited / std::fmax(1, outcome.time / setup.tick);
  outcome.fault = watchdog.fault();
  return outcome;
}

inline Contact_outcome run_contact(const Contact_setup& setup, double seconds) {
  return run_contact(setup, seconds, [](const auto&...) { return true; });
}

} // namespace haptic_sculpt::passivity_benchmark

#endif
