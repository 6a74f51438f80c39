// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/simulation/Torque_delay.h>
#include <haptic_sculpt/haptic_rendering/loop/require_number.h>

#include <array>
#include <cmath>

namespace haptic_sculpt {

/// Counts the energy that the rendered force takes from the hand, at the joints: minus the sum of the torque in force
/// times the joints' way. What stays below the work of friction for good is active: the device gives what nobody put
/// in.
///
/// The torque commanded at a tick works on the joint step to the *next* one. A delay of n + f ticks splits it:
/// (1 - f) tau(k - n) + f tau(k - n - 1). Exact for whole delays and exact angles.
class Passivity_observer {
public:
  /// \param tick s \param viscous_friction N m s/rad \param encoder_step rad; 0: exact angles \param lent J, what a
  /// potential may give before anybody has put it in: how deep it is
  /// \throw Error naming what no device has
  Passivity_observer(double delay_in_ticks, double tick, double viscous_friction, double encoder_step, double lent = 0)
      : delay_(delay_in_ticks), tick_(tick), friction_(viscous_friction), encoder_step_(encoder_step), lent_(lent) {
    internal::require_tick("the tick of a Passivity_observer", tick);
    internal::require_number("the viscous friction of a Passivity_observer", "N m s/rad", viscous_friction, 0, 1e5);
    internal::require_number("the encoder step of a Passivity_observer", "rad", encoder_step, 0, 1);
  }

  /// Takes the joint step since the last tick, before the torque of this one is commanded.
  /// \param stiffness N/m, of the credit for encoders \param handle_step the handle's way, m
  void add_step(const Eigen::Vector3d& joint_step, double stiffness, const Eigen::Vector3d& handle_step) {
    add_step(joint_step, stiffness, handle_step, tick_);
  }
  /// The same where the tick has truly taken so long: friction takes from a slow joint less than from a fast one on the
  /// same way. \param elapsed s, > 0; half of a tick at least counts
  void add_step(const Eigen::Vector3d& joint_step, double stiffness, const Eigen::Vector3d& handle_step,
                double elapsed) {
    const double before = energy() + dissipated_, taken = delay_.mean().dot(joint_step);
    port_ -= taken;
    // A joint known by counts has moved ever since the last one: as if it had moved in this tick alone, at a high rate,
    // friction would seem to take many times what it takes.
    double hidden = 0; // counts^2
    for (int joint = 0; joint < 3; ++joint) {
      since_[joint] += std::fmax(elapsed, 0.5 * tick_);
      if (const double step = joint_step[joint]; step != 0) {
        dissipated_ += friction_ * step * step / since_[joint];
        hidden += std::fmax(1.0 / 6, 1 - tick_ / since_[joint]);
        since_[joint] = 0;
      }
    }
    // A spring that sees counts seems to give energy (doc/proofs/haptic_stability.md, "What rounding can do").
    // The joints are taken to move the handle alike: by as much a radian as the whole step does.
    const double moved = joint_step.squaredNorm();
    if (encoder_step_ > 0 && moved > 0 && delay_.mean().squaredNorm() > 0)
      credit_ += 0.5 * stiffness * handle_step.squaredNorm() / moved * encoder_step_ * encoder_step_ * hidden;
    least_ = std::fmin(least_, energy() + dissipated_);
    is_blind_ = is_blind_ || !(std::abs(energy() + dissipated_ - before) + std::abs(taken) <= most_of_a_step);
  }
  /// What the hand has put in counts up to what can come back of it, J: the rest is friction's, and must not hide what
  /// the device gives an hour later. \param returnable the most that may come back from now on
  void forget_beyond(double returnable) {
    forgotten_ = std::fmax(forgotten_, energy() + dissipated_ - returnable);
  }
  /// Begins anew with nothing taken or given.
  void restart() { *this = Passivity_observer(delay_.ticks(), tick_, friction_, encoder_step_, lent_); }
  /// The torque of this tick without what carries the mechanism's own weight, N m.
  void command(const Eigen::Vector3d& torque) { delay_.command(torque); }

  double port() const { return port_; } ///< J, as seen; negative: given to the hand
  double energy() const { return port_ + credit_; } ///< J, with the credit for encoder steps
  double dissipated() const { return dissipated_; } ///< J, by viscous friction, as the joint steps say
  /// Whether the device has given more than anything that is allowed for can explain.
  bool is_active() const { return balance() < permitted - lent_; }
  /// Whether a step has had more work than most_of_a_step, or work that is no number: what the device gives after it is
  /// lost beside that. Until restart().
  bool is_blind() const { return is_blind_; }
  /// J; no hand has a GW in a tick of a ms, and sums of some such steps still show a hundredth of `permitted`.
  static constexpr double most_of_a_step = 1e6;
  /// energy() + dissipated(), J, less what has been forgotten.
  double balance() const { return energy() + dissipated_ - forgotten_; }
  /// J: what the loop may seem to have given, beyond the credit for encoders. A stiffness that grows while a hand
  /// presses (the ramp) gives some tenths of a mJ, a delay that is no whole number of ticks is seen to a tenth.
  static constexpr double permitted = -5e-3;
  /// The least of energy() + dissipated() so far, J. Below 0: somewhere the device was active.
  double least() const { return least_; }

private:
  Torque_delay<double> delay_;
  double tick_, friction_, encoder_step_, lent_;
  double port_ = 0, credit_ = 0, dissipated_ = 0, least_ = 0, forgotten_ = 0;
  std::array<double, 3> since_{}; ///< s, since each joint's last step
  bool is_blind_ = false;
};

} // namespace haptic_sculpt
