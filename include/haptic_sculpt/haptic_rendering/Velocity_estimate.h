// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <complex>

namespace haptic_sculpt {

/// The handle's velocity from its steps: the finite difference behind a low-pass of first order, exact for a held
/// input.
///
/// At 100 Hz encoder steps are felt as 9 to 13 mN of ripple with b = 2 N s/m; without a low-pass it is 14 to 26 mN, and
/// at 30 Hz the damper comes so late that the loop swings.
class Velocity_estimate {
public:
  static constexpr double default_cutoff = 100; ///< Hz
  /// What a damper b behind the low-pass makes of a step at most, N/m: 2 pi f b. \param damping b, N s/m
  static double change_of_way(double damping) { return 2 * double(EIGEN_PI) * default_cutoff * damping; }

  /// \param tick s \param cutoff of the low-pass, Hz
  explicit Velocity_estimate(double tick, double cutoff = default_cutoff)
      : tick_(tick), rate_(2 * double(EIGEN_PI) * cutoff), share_(-std::expm1(-rate_ * tick)) {}

  /// Takes the handle's step in one tick, m. \return m/s
  const Eigen::Vector3d& add(const Eigen::Vector3d& step) { return add(step, tick_); }
  /// The same where the tick has truly taken so long. \param elapsed s, > 0
  const Eigen::Vector3d& add(const Eigen::Vector3d& step, double elapsed) {
    const double share = elapsed == tick_ ? share_ : -std::expm1(-rate_ * elapsed);
    value_ += share * (step / elapsed - value_);
    return value_;
  }
  const Eigen::Vector3d& value() const { return value_; } ///< what the last add() gave, m/s; 0 before
  /// What becomes of steps (over the tick) that turn by an angle a tick.
  std::complex<double> response(double angle) const { return share_ / (1.0 - (1 - share_) * std::polar(1.0, -angle)); }
  void reset() { value_.setZero(); } ///< to 0 at once

private:
  double tick_, rate_, share_;
  Eigen::Vector3d value_ = Eigen::Vector3d::Zero();
};

} // namespace haptic_sculpt
