// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/simulation/Torque_delay.h>
#include <haptic_sculpt/device/simulation/encoder.h>
#include <haptic_sculpt/device/simulation/runge_kutta.h>
#include <haptic_sculpt/haptic_rendering/simulation/Hand_path.h>
#include <haptic_sculpt/haptic_rendering/Joint_reading.h>
#include <haptic_sculpt/haptic_rendering/simulation/Simulated_hand.h>

#include <Eigen/LU>

namespace haptic_sculpt {

/// The mechanism, simulated, in a simulated hand: a model of the concept of a device with joints (Joint_reading).
///
/// `write()` lives through one tick with the torque given, held, and late by the delay; `read()` says what encoders see
/// then.
class Simulated_device {
public:
  /// \param start where the mechanism rests first \param path of the hand; must outlive this \param tick s
  /// \throw Error for a hand or a delay that cannot be used
  Simulated_device(const Device_parameters<double>& parameters, const Device_pose<double>& start,
                   const Simulated_hand& hand, const Hand_path& path, double tick, double delay_in_ticks)
      : parameters_(parameters)
      , moving_(with_mass_at_handle(parameters, hand))
      , hand_(hand)
      , path_(&path)
      , tick_(tick)
      , held_(delay_in_ticks)
      , interaction_(delay_in_ticks) {
    state_.device.pose = start;
    state_.further << hand.at_rest(start.position), 0.0;
  }

  /// The angles as encoders see them now, the motors' torque in force, and the button of the path. Changes nothing.
  Joint_reading read() const {
    Joint_reading reading;
    reading.theta = measured_angles(parameters_, state_.device.pose.theta);
    reading.torque = held_.after();
    reading.button = path_->at(time()).button;
    reading.elapsed = ticks_ == 0 ? 0 : tick_;
    return reading;
  }

  /// \param interaction the part of the torque that is there for the hand: its work is the energy of the port
  /// \return `success`, or why the mechanism cannot move on; it stays where it is then. `not_finite` for torques that
  /// are not: nothing has happened; also where the motion overflows, as of a hand too stiff for its masses
  Device_status write(const Eigen::Vector3d& torque, const Eigen::Vector3d& interaction) {
    if (!torque.allFinite() || !interaction.allFinite())
      return Device_status::not_finite;
    const double limit = parameters_.torque_limit();
    held_.command(torque.cwiseMax(-limit).cwiseMin(limit));
    interaction_.command(interaction);
    const Coupled_state<double, states> state = state_;
    const double port = port_;
    // The tick is split where the torque changes, so that every step integrates what is smooth.
    const double fraction = held_.fraction();
    Device_status status = Device_status::success;
    if (fraction > 0)
      status = live(0, fraction * tick_, fraction > 0.5 ? 2 : 1, held_.before(), interaction_.before());
    if (status == Device_status::success)
      status =
          live(fraction * tick_, (1 - fraction) * tick_, fraction < 0.5 ? 2 : 1, held_.after(), interaction_.after());
    if (status != Device_status::success)
      state_ = state, port_ = port;
    ++ticks_;
    return status;
  }

  /// The same without a part for the hand.
  Device_status write(const Eigen::Vector3d& torque) { return write(torque, Eigen::Vector3d::Zero()); }

  /// Gives the handle a velocity, m/s; where the Jacobian is singular nothing.
  void push(const Eigen::Vector3d& velocity) {
    if (const auto map = jacobian(parameters_, state_.device.pose))
      state_.device.rate = map->linear.fullPivLu().solve(velocity);
  }

  double time() const { return static_cast<double>(ticks_) * tick_; } ///< s since the start
  const Device_state<double>& state() const { return state_.device; } ///< the true one, which encoders round
  /// \name True energies, J
  ///@{
  double port() const { return port_; } ///< that the interaction torques took from the mechanism
  double dissipated() const { return state_.further[Simulated_hand::most_states]; } ///< by friction of the joints
  ///@}

private:
  static constexpr int states = Simulated_hand::most_states + 1;
  Device_parameters<double> parameters_, moving_;
  Simulated_hand hand_;
  const Hand_path* path_;
  double tick_, port_ = 0;
  std::uint64_t ticks_ = 0;
  Torque_delay<double> held_, interaction_;
  Coupled_state<double, states> state_;

  static Device_parameters<double> with_mass_at_handle(const Device_parameters<double>& parameters,
                                                       const Simulated_hand& hand) {
    hand.check();
    Device_description<double> d = parameters.description();
    d.platform_mass += hand.stage[0].mass;
    return Device_parameters<double>(d);
  }

  Device_status live(double begin, double length, int steps, const Eigen::Vector3d& torque,
                     const Eigen::Vector3d& interaction) {
    const Eigen::Vector3d before = state_.device.pose.theta;
    for (int k = 0; k < steps; ++k) {
      const double start = time() + begin + k * length / steps;
      const auto next = runge_kutta_step(
          moving_, Dynamics_model::spatial, state_, start, length / steps,
          [&](const Device_motion<double>& motion, const Further_states<double, states>& further, double now) {
            const Hand_path::Wish wish = path_->at(now);
            const auto effect = hand_.effect(further.head<Simulated_hand::most_states>(), motion.pose.position,
                                             motion.velocity.linear, wish.position, wish.velocity);
            const Eigen::Vector3d carried(0, 0, hand_.stage[0].mass * parameters_.gravity());
            Surroundings_effect<double, states> all;
            all.torque = torque + motion.jacobian.linear.transpose() * (effect.force + carried);
            all.further_rate << effect.rates, -joint_friction(parameters_, motion.rate).dot(motion.rate);
            return all;
          });
      if (!next)
        return next.status();
      state_ = *next;
    }
    port_ -= interaction.dot(state_.device.pose.theta - before);
    return Device_status::success;
  }
};

} // namespace haptic_sculpt
