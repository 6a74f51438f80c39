// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_passivity/Random_contacts.h"

#include <Eigen/SVD>

namespace haptic_sculpt::passivity_benchmark {

/// The energy that a held spring takes from joints led there and back over work of their friction; below -1 it is
/// active. A hand that dissipates would hide it.
///
/// The spring is preloaded and pulls along J's top left singular vector; the joints turn along the right one at a
/// constant rate, and nothing depends on how heavy they are. Ticks under a torque of before the motion do not count.
inline double energy_over_friction(const Device_parameters<double>& device, const Device_pose<double>& pose,
                                   const Virtual_coupling& coupling, double tick, double delay) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(jacobian(device, pose)->linear,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d normal = svd.matrixU().col(0), way = svd.matrixV().col(0);
  const double rate = 0.01, preload = 0.002; // rad/s, m
  const int half = 200, settling = 100 + static_cast<int>(delay);
  Passivity_observer observer(delay, tick, device.viscous_friction(), 0);
  Handle_motion handle(device, pose, tick);
  double port = 0, dissipated = 0;
  Contact_span span;
  span.add(normal);
  for (int k = 0; k <= settling + 4 * half; ++k) { // a whole number of periods once the damper's low-pass has settled
    const int phase = k % (2 * half);
    handle.follow(pose.theta + way * rate * tick * (phase <= half ? phase : 2 * half - phase));
    observer.add_step(handle.joint_step(), 0, handle.step());
    if (k == settling + 2 * half)
      port = observer.port(), dissipated = observer.dissipated();
    const double depth = preload - normal.dot(handle.position() - pose.position);
    observer.command(handle.jacobian().linear.transpose() *
                     (coupling.stiffness * depth * normal + coupling.damping_force(span, handle.velocity(), false)));
  }
  return (observer.port() - port) / (observer.dissipated() - dissipated);
}

/// The stiffness, N/m, at which activity begins, by halving between a hundredth of the formula and ten times it.
inline double activity_stiffness(const Device_parameters<double>& device, const Device_pose<double>& pose,
                                 double damping, double tick, double delay) {
  const double greatest = translation_conditioning(*jacobian(device, pose)).greatest;
  const double limit = passive_stiffness(device.viscous_friction() / (greatest * greatest), 0, tick, delay);
  double low = 0.01 * limit, high = 10 * limit;
  for (int halving = 0; halving < 20; ++halving) {
    const double middle = 0.5 * (low + high);
    (energy_over_friction(device, pose, {middle, damping}, tick, delay) < -1 ? high : low) = middle;
  }
  return low;
}

/// Over the formula, at b = 0.
struct Activity {
  int tried = 0;
  double least = 1e300, largest = 0;
};
inline Activity activity(std::uint64_t seed, int count, double delay) {
  Draw draw(seed);
  Activity found;
  while (found.tried < count) {
    const Device_form form = found.tried % 2 == 0 ? Device_form::ditetrahedral : Device_form::general;
    const Device_parameters<double> device = design(form, 0.005, 0, 0, 10);
    const double a = draw(0.4, 1.6), b = draw(0.4, 1.6), c = draw(0.4, 1.6), tick = draw.logarithmic(2.5e-4, 4e-3);
    const auto pose = forward_kinematics(device, Eigen::Vector3d(a, b, c));
    if (!pose)
      continue;
    const auto conditioning = translation_conditioning(*jacobian(device, *pose));
    if (!(conditioning.condition <= 10))
      continue;
    const double limit = passive_stiffness(0.005 / (conditioning.greatest * conditioning.greatest), 0, tick, delay);
    const double ratio = activity_stiffness(device, *pose, 0, tick, delay) / limit;
    found.least = std::fmin(found.least, ratio), found.largest = std::fmax(found.largest, ratio);
    ++found.tried;
  }
  return found;
}

} // namespace haptic_sculpt::passivity_benchmark
