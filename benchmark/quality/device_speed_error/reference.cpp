// SPDX-License-Identifier: GPL-3.0-or-later
#include "device_speed_error/reference.h"

namespace haptic_sculpt::benchmark {

Reference::Reference(const Device_description<Exact>& rounded, const Device_description<Exact>& otherwise)
    : parameters_(violations(rounded).empty() ? rounded : otherwise) {}

Reference::State Reference::state(const Device_vector<Exact>& angles, const Device_vector<Exact>& rates,
                                  const Device_vector<Exact>& accelerations) const {
  const auto pose = forward_kinematics(parameters_, angles);
  return {pose->position, spatial_inverse_dynamics(parameters_, *pose, rates, accelerations)->torque};
}

Device_vector<Exact> Reference::inverse(const Device_vector<Exact>& point, const Eigen::Vector3i& knees) const {
  return ditetrahedral_inverse(parameters_, point, knees)->theta;
}

} // namespace haptic_sculpt::benchmark
