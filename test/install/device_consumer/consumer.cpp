// SPDX-License-Identifier: GPL-3.0-or-later
// The device from an installed package, without CGAL: a pose, its Jacobian, and there and back.
#include <haptic_sculpt/device.h>
#ifdef HAPTIC_SCULPT_DEVICE_ASSEMBLY_MODES_H
#error "the modes and the eigenvalues, which take time to compile, are for those who ask"
#endif
#include <haptic_sculpt/device/forward_by_all_modes.h>
#include <cstdio>

int main() {
  using namespace haptic_sculpt;
  const Device_parameters<double> parameters(named_design(Named_design::D1, Device_form::general));
  const Device_vector<double> theta(0.9, 1.0, 1.1);
  const auto pose = forward_kinematics(parameters, theta);
  if (!pose || !jacobian(parameters, *pose) || !forward_by_all_modes(parameters, theta))
    return 1;
  const auto back = general_inverse(parameters, pose->position, *pose);
  if (!back || (back->theta - theta).norm() > 1e-12)
    return 1;
  std::printf("platform at %g %g %g m\n", pose->position[0], pose->position[1], pose->position[2]);
}
