// SPDX-License-Identifier: GPL-3.0-or-later
// The device: from joint angles to the platform and back, and the torques that let the hand feel a force.
#include <haptic_sculpt/device.h>

#include <iostream>

int main() {
  using namespace haptic_sculpt;
  const Device_parameters<double> device(named_design(Named_design::D1, Device_form::general)); // lengths in metres

  // Forward: three joint angles in radians give the platform's place and attitude.
  const Device_vector<double> theta(0.9, 1.0, 1.1);
  const auto pose = forward_kinematics(device, theta);
  if (!pose) { // an answer, too: why there is none, and how much is lacking
    std::cout << name_of(pose.status()) << ", short by " << pose.shortfall() << '\n';
    return 1;
  }
  std::cout << "platform at " << pose->position.transpose() << " m\n";

  // Inverse: the angles for a place, reached from a pose known.
  const Device_vector<double> place = pose->position + Device_vector<double>(0.004, -0.002, 0.003);
  const auto there = general_inverse(device, place, *pose);
  if (!there)
    return 1;
  std::cout << "angles there " << there->theta.transpose() << " rad\n";

  // What cannot be reached is said, with the distance that is left.
  const auto too_far = general_inverse(device, Device_vector<double>(0, 0, 1), *pose);
  std::cout << "a metre up: " << name_of(too_far.status()) << ", " << too_far.shortfall() << " m short\n";

  // The Jacobian takes joint speeds to the platform's; its transpose takes a force at the platform to joint torques.
  const auto J = jacobian(device, *there);
  if (!J)
    return 1;
  const Device_vector<double> force(0, 0, 1); // N
  std::cout << "torques for 1 N upwards " << (J->linear.transpose() * force).transpose() << " N m\n";

  const auto again = forward_kinematics(device, there->theta, *pose);
  const bool is_back = again && (again->position - place).norm() < 1e-12;
  std::cout << "forward again: " << (is_back ? "the same place\n" : "another place\n");
  return is_back && !too_far ? 0 : 1;
}
