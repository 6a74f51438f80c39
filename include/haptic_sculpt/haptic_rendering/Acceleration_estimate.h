// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <complex>

namespace haptic_sculpt {

/// An acceleration from steps, tick by tick: the second difference behind two low-passes of first order, led on in
/// time.
///
/// The second difference belongs to the tick before, and each low-pass of share s is (1 - s)/s ticks late: L ticks
/// together. The last change is led on by L, so what grows linearly is followed without any lag; a sinusoid of angular
/// frequency w is off by (w T)^2 E of itself, E = (L^2 + L)/2 - (1 - s)/s^2 - 1/12. Where that is more than
/// `permitted_error` at `faithful_to`, the last change of the change takes off the rest: below some 450 Hz, and not
/// above, because it lets more of the high frequencies through.
class Acceleration_estimate {
public:
  static constexpr double default_cutoff = 100;    ///< Hz
  static constexpr double faithful_to = 5;         ///< Hz: how fast hands shake what they hold
  static constexpr double permitted_error = 0.009; ///< of the acceleration, there

  /// \param tick s \param cutoff of each low-pass, Hz
  explicit Acceleration_estimate(double tick, double cutoff = default_cutoff)
      : tick_(tick), share_(-std::expm1(-2 * pi * cutoff * tick)), lag_(1 + 2 * (1 - share_) / share_) {
    const double error = (lag_ * lag_ + lag_) / 2 - (1 - share_) / (share_ * share_) - 1.0 / 12;
    curvature_ = std::fmax(0.0, error - permitted_error / std::pow(2 * pi * faithful_to * tick, 2));
  }

  /// Takes the step of one tick, in m or rad. \return m/s^2 or rad/s^2
  const Eigen::Vector3d& add(const Eigen::Vector3d& step) { return add(step, tick_); }
  /// The same where the tick has truly taken so long; the low-passes go on by the tick. \param time since the last, s,
  /// > 0; half of a tick at least counts
  const Eigen::Vector3d& add(const Eigen::Vector3d& step, double time) {
    const double elapsed = std::fmax(time, 0.5 * tick_);
    const Eigen::Vector3d velocity = step / elapsed;
    const Eigen::Vector3d second =
        has_step_ ? Eigen::Vector3d(2 * (velocity - velocity_) / (elapsed + elapsed_)) : Eigen::Vector3d(0, 0, 0);
    velocity_ = velocity, elapsed_ = elapsed, has_step_ = true;
    const Eigen::Vector3d before = second_pass_, change_before = change_;
    first_pass_ += share_ * (second - first_pass_);
    second_pass_ += share_ * (first_pass_ - second_pass_);
    change_ = second_pass_ - before;
    value_ = second_pass_ + lag_ * change_ + curvature_ * (change_ - change_before);
    return value_;
  }
  const Eigen::Vector3d& value() const { return value_; } ///< what the last add() gave; 0 before
  /// What becomes of second differences (over the square of the tick) that turn by an angle a tick.
  std::complex<double> response(double angle) const {
    const std::complex<double> q = std::polar(1.0, -angle), pass = share_ / (1.0 - (1 - share_) * q);
    return pass * pass * (1.0 + lag_ * (1.0 - q) + curvature_ * (1.0 - q) * (1.0 - q));
  }
  /// Forgets all steps: the next one is the first, and gives 0.
  void reset() {
    has_step_ = false;
    first_pass_.setZero(), second_pass_.setZero(), change_.setZero(), value_.setZero();
  }

private:
  static constexpr double pi = EIGEN_PI;

  double tick_, share_, lag_, curvature_, elapsed_ = 0;
  bool has_step_ = false;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero(), first_pass_ = Eigen::Vector3d::Zero(),
                  second_pass_ = Eigen::Vector3d::Zero(), change_ = Eigen::Vector3d::Zero(),
                  value_ = Eigen::Vector3d::Zero();
};

} // namespace haptic_sculpt
