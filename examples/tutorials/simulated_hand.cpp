// SPDX-License-Identifier: GPL-3.0-or-later
// The device in simulation, held by a hand that is a mass on a spring and a damper.
#include <haptic_sculpt/device.h>

#include <iostream>

int main() {
  using namespace haptic_sculpt;
  const Device_parameters<double> parameters(named_design(Named_design::D1, Device_form::general));
  const Device_vector<double> theta(1.0, 1.0, 1.0), no_torque = Device_vector<double>::Zero();
  const auto pose = forward_kinematics(parameters, theta);
  if (!pose)
    return 1;
  Further_states<double, 6> hand_at_rest;
  hand_at_rest << pose->position + Device_vector<double>(0, 0, 0.005), no_torque; // its place 5 mm higher; its velocity

  Torque_delay<double> delay(0.5); // ticks
  Coupled_state<double, 6> state{{*pose}, hand_at_rest};
  const auto hand = [&](const Device_motion<double>& motion, const Further_states<double, 6>& y, double) {
    const Device_vector<double> grip =
        375 * (y.head<3>() - motion.pose.position) + 7.9 * (y.tail<3>() - motion.velocity.linear); // N
    Surroundings_effect<double, 6> effect;
    effect.torque = motion.jacobian.linear.transpose() * grip;
    effect.further_rate << y.tail<3>(), -grip / 1.46; // kg
    return effect;
  };
  for (int tick = 0; tick < 50; ++tick) {
    const auto J = jacobian(parameters, state.device.pose);
    if (!J)
      return 1;
    delay.command(gravity_torque(parameters, state.device.pose, *J)); // what a loop gives: here it bears the device
    const auto next = simulate_tick(parameters, Dynamics_model::spatial, state, 0.001 * tick, 0.001, delay, hand);
    if (!next) { // a pose that the mechanism cannot leave
      std::cout << name_of(next.status()) << '\n';
      return 1;
    }
    state = *next;
  }
  const double way = state.device.pose.position.z() - pose->position.z();
  std::cout << "after 50 ms the hand has drawn the handle up by " << way * 1000 << " mm\n";
  return way > 0.001 && way < 0.01 ? 0 : 1;
}
