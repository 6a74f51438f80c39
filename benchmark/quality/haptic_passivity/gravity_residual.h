// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_passivity/Random_contacts.h"
#include "../../common/quantile.h"

#include <haptic_sculpt/device/dynamics.h>

#include <algorithm>
#include <array>
#include <vector>

namespace haptic_sculpt::passivity_benchmark {

/// What is left of the mechanism's weight in the hand, N: magnitudes of J^-T (what motors give - what holds it).
struct Gravity_residual {
  double median = 0, p99 = 0, largest = 0;
  double condition = 0; ///< cond(J) where it is largest
};

/// Where a residual may come from.
enum class Residual_source {
  encoders,         ///< compensation at the angles that encoders tell
  holding,          ///< exact angles, a tick of 1 ms at 60 mm/s in a random direction, at its end
  encoders_holding, ///< both
  planar_model      ///< exact angles; the weight as the paper's planar links have it
};

/// Over poses drawn in the joint limits with cond(J) <= 10 and the knees as at home.
inline Gravity_residual gravity_residual(std::uint64_t seed, Device_form form, Residual_source source,
                                         double encoder_step, int count) {
  Draw draw(seed);
  const Device_parameters<double> device = design(form, 0, 0, encoder_step, 10);
  const auto home = home_pose(device);
  const Eigen::Vector3d low = device.least_angle(), span = device.greatest_angle() - low;
  const bool has_steps = source == Residual_source::encoders || source == Residual_source::encoders_holding;
  const bool is_held = source == Residual_source::holding || source == Residual_source::encoders_holding;
  std::vector<double> found;
  Gravity_residual residual;
  while (static_cast<int>(found.size()) < count) {
    const double a = draw(), b = draw(), c = draw();
    const auto pose = forward_kinematics(device, Eigen::Vector3d(low + span.cwiseProduct(Eigen::Vector3d(a, b, c))));
    const Eigen::Vector3d direction = draw.direction();
    if (!pose || working_mode(device, *pose) != working_mode(device, *home))
      continue;
    const auto map = jacobian(device, *pose);
    if (!map)
      continue;
    const double condition = translation_conditioning(*map).condition;
    if (!(condition <= 10))
      continue;
    Eigen::Vector3d told = pose->theta; // the angles for which the motors are set
    if (is_held)
      told -= map->linear.partialPivLu().solve(0.06 * 0.001 * direction);
    if (has_steps)
      told = measured_angles(device, told);
    const auto told_pose = forward_kinematics(device, told, *pose);
    const auto told_map = jacobian(device, *told_pose);
    Eigen::Vector3d given = gravity_torque(device, *told_pose, *told_map);
    if (source == Residual_source::planar_model) {
      const auto terms =
          dynamics(device, Dynamics_model::planar, *told_pose, Device_vector<double>(Eigen::Vector3d::Zero()));
      if (!terms)
        continue;
      given = terms->gravity;
    }
    const Eigen::Vector3d off = given - gravity_torque(device, *pose, *map);
    found.push_back(map->linear.transpose().partialPivLu().solve(off).norm());
    if (found.back() > residual.largest)
      residual.largest = found.back(), residual.condition = condition;
  }
  residual.median = benchmark::quantile(found, 0.5), residual.p99 = benchmark::quantile(found, 0.99);
  return residual;
}

} // namespace haptic_sculpt::passivity_benchmark
