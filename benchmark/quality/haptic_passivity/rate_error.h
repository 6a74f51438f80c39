// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_passivity/Random_contacts.h"

namespace haptic_sculpt::passivity_benchmark {

/// Of the force in the hand against the spring's at that moment, N.
struct Rate_error {
  double mean = 0, largest = 0;           ///< of the force that is held
  double felt_mean = 0, felt_largest = 0; ///< of J^-T times the torques that are held, while J turns
};

/// The handle is led straight into a plane at home, at constant speed, to a depth of 6 mm.
inline Rate_error rate_error(double rate, double delay, double speed, double stiffness, double encoder_step) {
  const Device_parameters<double> device = design(Device_form::ditetrahedral, 0.005, 0, encoder_step, 10);
  const auto home = home_pose(device);
  const Eigen::Vector3d normal = Eigen::Vector3d(0.3, -0.2, 1).normalized();
  Handle_motion handle(device, *home, 1 / rate);
  Torque_delay<double> held_force(delay), held_torque(delay);
  Device_pose<double> pose = *home;
  Rate_error error;
  int samples = 0;
  constexpr int parts = 16;
  const int ticks = static_cast<int>(0.006 / speed * rate), settled = 2 + static_cast<int>(delay);
  const auto place = [&](double t) { return Eigen::Vector3d(home->position - speed * t * normal); };
  for (int k = 0; k < ticks; ++k) {
    pose = *reach_position(device, pose, place(k / rate));
    handle.follow(measured_angles(device, pose.theta));
    const Eigen::Vector3d force = -stiffness * normal * normal.dot(handle.position() - home->position);
    held_force.command(force), held_torque.command(handle.jacobian().linear.transpose() * force);
    for (int part = 0; part < parts && k >= settled; ++part) {
      const double fraction = (part + 0.5) / parts;
      const auto there = reach_position(device, pose, place((k + fraction) / rate));
      const Eigen::Vector3d exact = -stiffness * normal * normal.dot(there->position - home->position);
      const bool is_old = fraction < held_force.fraction();
      const double off = ((is_old ? held_force.before() : held_force.after()) - exact).norm();
      const Eigen::Matrix3d transposed = jacobian(device, *there)->linear.transpose();
      const Eigen::Vector3d felt = transposed.partialPivLu().solve(is_old ? held_torque.before() : held_torque.after());
      error.mean += off, error.felt_mean += (felt - exact).norm(), ++samples;
      error.largest = std::fmax(error.largest, off);
      error.felt_largest = std::fmax(error.felt_largest, (felt - exact).norm());
    }
  }
  error.mean /= samples, error.felt_mean /= samples;
  return error;
}

} // namespace haptic_sculpt::passivity_benchmark
