// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_passivity/prescribed_motion.h"

namespace haptic_sculpt::passivity_benchmark {

/// The hands that stability is tried in.
inline std::vector<Simulated_hand> hands_of_chart() {
  return {Simulated_hand::finger(),
          Simulated_hand::arm(),
          Simulated_hand::measured_arm(),
          {1, {{{0, 50, 0.5}}}},
          {1, {{{0.1, 800, 4}}}}};
}

/// Such as hold a handle in a clamp, with hardly any damping.
inline std::vector<Simulated_hand> stiff_hands() {
  return {{1, {{{0, 1000, 0.3}}}}, {1, {{{0, 3000, 0.3}}}}, {1, {{{0, 3000, 3}}}}};
}

/// Whether a handle that a hand presses on a plane does not buzz: in the last quarter of a second its acceleration from
/// tick to tick is below 1 m/s^2 in the mean, or has fallen by a tenth since the quarter before. How a slow hand swings
/// on its own arm, some tenths of a m/s^2, does not count.
inline bool is_calm(const Contact_setup& setup) {
  double earlier = 0, later = 0;
  Eigen::Vector3d last = setup.start.position, step = Eigen::Vector3d::Zero();
  const auto outcome = run_contact(setup, 1e9, [&](const Simulated_device& device, const Handle_motion&, const auto&) {
    const Eigen::Vector3d next = device.state().pose.position - last;
    double& quarter = device.time() < 0.75 ? earlier : later;
    if (device.time() > 0.5)
      quarter += (next - step).norm() / setup.tick / 0.25;
    last += next, step = next;
    return device.time() < 1;
  });
  return !outcome.has_left && outcome.fault == Loop_fault::none && (later < 1 || later < 0.9 * earlier);
}

/// Pressed on a plane normal to the direction in which friction is least, at a pose.
inline Contact_setup pressed(const Device_parameters<double>& device, const Device_pose<double>& pose,
                             const Simulated_hand& hand, const Virtual_coupling& coupling, double tick, double delay) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(jacobian(device, pose)->linear, Eigen::ComputeFullU);
  const Eigen::Vector3d normal = svd.matrixU().col(0);
  const Hand_path path({{0, pose.position + 0.0005 * normal, 0}, {0.1, pose.position - 0.006 * normal, 0}});
  const auto start = reach_position(device, pose, path.rows().front().position);
  Contact_setup setup{device, *start, pose.position, normal, path, hand};
  setup.tick = tick, setup.delay = delay, setup.coupling = coupling;
  setup.greatest = 1e9, setup.most_condition = 100;
  setup.controller_damping = 0, setup.follows_pose = false; // stability of the coupling alone
  return setup;
}

/// The largest amount, by halving up to `most`, with which it buzzes in no hand. \param setup_of `setup_of(hand,
/// amount)`
template <class Setup_of>
double largest_stable(double most, const Setup_of& setup_of) {
  double low = 0, high = most;
  for (int halving = 0; halving < 8; ++halving) {
    const double middle = 0.5 * (low + high);
    bool is_stable = true;
    for (const Simulated_hand& hand : hands_of_chart())
      is_stable = is_stable && is_calm(setup_of(hand, middle));
    (is_stable ? low : high) = middle;
  }
  return low;
}

/// The largest stiffness, N/m.
inline double largest_stable_stiffness(const Device_parameters<double>& device, const Device_pose<double>& pose,
                                       double damping, double tick, double delay, double most) {
  return largest_stable(most, [&](const Simulated_hand& hand, double stiffness) {
    return pressed(device, pose, hand, {stiffness, damping}, tick, delay);
  });
}

/// The largest damping, N s/m, with a stiffness.
inline double largest_stable_damping(const Device_parameters<double>& device, const Device_pose<double>& pose,
                                     double stiffness, double tick, double delay, double most) {
  return largest_stable(most, [&](const Simulated_hand& hand, double damping) {
    return pressed(device, pose, hand, {stiffness, damping}, tick, delay);
  });
}

/// The largest virtual mass, kg, while nothing is touched.
inline double largest_stable_mass(const Device_parameters<double>& device, const Device_pose<double>& pose, double tick,
                                  double delay, double most) {
  return largest_stable(most, [&](const Simulated_hand& hand, double mass) {
    Contact_setup setup = pressed(device, pose, hand, {0, 0}, tick, delay);
    setup.virtual_mass.mass = mass;
    return setup;
  });
}

} // namespace haptic_sculpt::passivity_benchmark
