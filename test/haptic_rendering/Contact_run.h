// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_rendering/devices_of_tests.h"

#include <haptic_sculpt/haptic_rendering/loop/Interaction.h>
#include <haptic_sculpt/haptic_rendering/critical_gains.h>
#include <haptic_sculpt/haptic_rendering/simulation/Simulated_device.h>

#include <Eigen/Eigenvalues>

#include <optional>

namespace haptic_rendering_tests {

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
  Virtual_mass_parameters virtual_mass{};
  std::optional<double> controller_damping{};            ///< N s/m; none: half of what may be asked for, as in a loop
  bool follows_pose = Haptic_parameters().follows_pose; ///< couplings are chosen for the poses of a run
  double burst_every = 0;        ///< s; 0: no edits are refused
  double starved_share = 0;      ///< of the ticks, the first of each 0.1 s: work is cut short before the plane is found
  Eigen::Vector3d speed = Eigen::Vector3d::Zero(); ///< that the handle is given, m/s
  double push_time = 1e300;                        ///< when, s

  /// That may be asked for, N s/m, at the pose of the start.
  double largest_controller() const {
    const auto terms = dynamics(device, Dynamics_model::spatial, start, Device_vector<double>(0, 0, 0));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> mass(
        apparent_mass(terms->mass, jacobian(device, start)->linear), Eigen::EigenvaluesOnly);
    return mass.eigenvalues()[0] * largest_damping_rate(tick, delay, std::numeric_limits<double>::infinity());
  }
  Haptic_parameters parameters() const {
    Haptic_parameters all;
    all.tick = tick, all.delay = delay, all.coupling = coupling, all.limits = limits, all.virtual_mass = virtual_mass;
    all.follows_pose = follows_pose;
    return all;
  }
};

/// Energies in J.
struct Contact_outcome {
  double contact = 0, time = 0; ///< s
  std::size_t ticks = 0;        ///< in contact
  double least = 0;             ///< of the port's true energy plus physical dissipation, at any tick
  double least_port = 0;        ///< of the port's alone
  double largest_port = 0;      ///< magnitude
  double observer_error = 0;    ///< the observer's port against the true one, at most
  double least_observed = 0;    ///< of the observer's energy with its credit, plus the dissipation that it sees
  double mass_energy = 0;       ///< taken from the hand by virtual mass, before limits
  double largest_force = 0;     ///< N, rendered
  double limited = 0;           ///< share of the ticks in which limits changed the force
  double off = 0, most_off = 0; ///< N, mean and largest in contact, of the force: from that of the true place
  bool has_left = false; ///< the poses for which the coupling was chosen
  Loop_fault fault = Loop_fault::none;
};

/// The less and the greater of two; none where one is no number, which std::fmin() and std::fmax() would leave out.
inline double less_of(double a, double b) {
  return std::isnan(a) ? a : std::isnan(b) ? b : std::fmin(a, b);
}
inline double greater_of(double a, double b) {
  return -less_of(-a, -b);
}

/// Until `seconds` of contact have been, or three times as long has passed.
/// \param each called after every tick with the handle; returns false to end
template <class Each>
Contact_outcome run_contact(Contact_setup setup, double seconds, const Each& each) {
  const Device_parameters<double>& device = setup.device;
  Simulated_device simulated(device, setup.start, setup.hand, setup.path, setup.tick, setup.delay);
  Interaction<Joint_side> loop(Joint_side(device, setup.start, setup.parameters()), setup.parameters(),
                               setup.controller_damping.value_or(setup.largest_controller() / 2));
  const Handle_motion& handle = loop.side().handle();
  const Passivity_observer& observer = loop.observer();
  Touch touch;
  touch.span.add(setup.normal), touch.holds = true;
  Contact_outcome outcome;
  double next_burst = setup.burst_every, limited = 0;
  while (outcome.contact < seconds && outcome.time < 3 * seconds) {
    if (outcome.time >= setup.push_time)
      simulated.push(setup.speed), setup.push_time = 1e300;
    const Joint_reading reading = simulated.read();
    if (!loop.follow(reading))
      break;
    const auto conditioning = translation_conditioning(handle.jacobian());
    outcome.has_left = conditioning.greatest > setup.greatest || conditioning.condition > setup.most_condition;
    if (outcome.has_left)
      break;
    outcome.observer_error = greater_of(outcome.observer_error, std::abs(observer.port() - simulated.port()));
    const double depth = -setup.normal.dot(handle.position() - setup.on_plane);
    const bool reached = depth <= 0;
    touch.is_free = reached, touch.way = std::fmax(0, depth) * setup.normal;
    touch.is_starved = std::fmod(outcome.time, 0.1) < 0.1 * setup.starved_share;
    if (setup.burst_every > 0 && outcome.time >= next_burst)
      loop.refuse(setup.normal), next_burst += setup.burst_every;
    loop.render(touch);
    loop.end_tick();
    const Rendered_force& rendered = loop.rendered();
    if (!reached) {
      const double true_depth = -setup.normal.dot(simulated.state().pose.position - setup.on_plane);
      const double off = (rendered.force - setup.coupling.stiffness * std::fmax(0, true_depth) * setup.normal -
                          setup.coupling.damping_force(touch.span, loop.side().velocity(), false)).norm();
      outcome.off += off, outcome.most_off = greater_of(outcome.most_off, off);
    }
    limited += (rendered.force - loop.wanted()).norm() > 1e-9 * (1 + loop.wanted().norm());
    if (simulated.write(rendered.torque, rendered.interaction_torque) != Device_status::success) {
      outcome.has_left = true;
      break;
    }
    outcome.time = simulated.time();
    outcome.ticks += !reached, outcome.contact += reached ? 0 : setup.tick;
    outcome.least = less_of(outcome.least, simulated.port() + simulated.dissipated());
    outcome.least_port = less_of(outcome.least_port, simulated.port());
    outcome.largest_port = greater_of(outcome.largest_port, std::abs(simulated.port()));
    outcome.largest_force = greater_of(outcome.largest_force, rendered.force.norm());
    if (!each(simulated, handle, rendered))
      break;
  }
  outcome.least_observed = observer.least();
  outcome.mass_energy = loop.virtual_mass().energy();
  outcome.limited = limited / std::fmax(1, outcome.time / setup.tick);
  outcome.off /= std::fmax(1, static_cast<double>(outcome.ticks));
  outcome.fault = loop.fault();
  return outcome;
}

inline Contact_outcome run_contact(const Contact_setup& setup, double seconds) {
  return run_contact(setup, seconds, [](const auto&...) { return true; });
}

} // namespace haptic_rendering_tests
