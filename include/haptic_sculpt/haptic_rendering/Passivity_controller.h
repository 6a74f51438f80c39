// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Passivity_observer.h>

namespace haptic_sculpt {

/// Takes back from the hand what the observer says it was given: a damper that is there only while energy is missing,
/// and only so strong that it takes the rest in one tick.
///
/// Time-domain passivity control (Hannaford, Ryu, IEEE Transactions on Robotics and Automation 18 (2002) 1-10), of the
/// kind that reads velocity and gives force. It differs in what counts as missing: the work of the joints' own friction
/// is set off first, and encoder steps are credited, or it would buzz in loops that are passive with their friction.
/// A net, not a licence: what it can take in a tick is bounded, because too strong a damper is unstable itself.
class Passivity_controller {
public:
  static constexpr double largest_damping = 1e5; ///< that one may have, N s/m: beyond it a number is a wrong unit

  /// \param most_damping of the damper, N s/m; 0: never there \param tick s \throw Error naming what cannot be used
  Passivity_controller(double most_damping, double tick) : most_damping_(most_damping), tick_(tick) {
    internal::require_number("the most damping of a Passivity_controller", "N s/m", most_damping, 0, largest_damping);
    internal::require_tick("the tick of a Passivity_controller", tick);
  }

  /// The force on the hand, N; exactly 0 where nothing is missing.
  /// \param step of the handle since the last tick, m
  Eigen::Vector3d force(const Passivity_observer& observer, const Eigen::Vector3d& step) {
    return force(observer, step, tick_);
  }
  /// The same where the tick has truly taken so long. \param elapsed s, > 0; half of a tick at least counts
  Eigen::Vector3d force(const Passivity_observer& observer, const Eigen::Vector3d& step, double elapsed) {
    const double missing = -observer.balance();
    // A low-pass would come too late for what buzzes.
    const Eigen::Vector3d velocity = step / std::fmax(elapsed, 0.5 * tick_);
    const double square = velocity.squaredNorm();
    damping_ = 0;
    if (!(most_damping_ > 0 && missing > 0) || !(square > least_speed * least_speed))
      return Eigen::Vector3d::Zero();
    damping_ = std::fmin(most_damping_, missing / (std::fmax(elapsed, tick_) * square)); // as long as the next may be
    return -damping_ * velocity;
  }
  /// The damper of the last force(), N s/m.
  double damping() const { return damping_; }

private:
  /// m/s; a slower handle takes no energy worth a damper, and its direction is that of rounding.
  static constexpr double least_speed = 1e-6;

  double most_damping_, tick_, damping_ = 0;
};

} // namespace haptic_sculpt
