// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_REFUSAL_BURST_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_REFUSAL_BURST_H

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace haptic_sculpt {

/// What an edit that is refused feels like: a short buzz, 125 Hz under a Hann window.
///
/// Its samples are odd about its middle, so that they sum to 0, and the window leaves nothing at low frequencies: the
/// handle ends where it was, and is never farther from there than some hundredths of a millimetre.
class Refusal_burst {
public:
  static constexpr double frequency = 125; ///< Hz, where fingers feel least amplitudes
  static constexpr double duration = 0.05; ///< s
  static constexpr double amplitude = 1;   ///< N

  /// \param tick s; at rates below 500 Hz the frequency is a quarter of the rate, which the motors can still render
  explicit Refusal_burst(double tick)
      : samples_(std::max(2, static_cast<int>(std::lround(duration / tick))))
      , tick_(tick)
      , frequency_(std::min(double(frequency), 0.25 / tick)) {}

  /// Begins along a direction; one under way goes on in its own.
  void begin(const Eigen::Vector3d& direction) {
    if (is_over())
      direction_ = direction.normalized(), next_ = 0;
  }
  bool is_over() const { return next_ >= samples_; }

  /// The force of the next tick, N.
  Eigen::Vector3d next() {
    if (is_over())
      return Eigen::Vector3d::Zero();
    return sample(next_++) * direction_;
  }

  int samples() const { return samples_; }
  /// \pre 0 <= k < samples()
  double sample(int k) const {
    const double pi = 3.14159265358979323846;
    const int from_middle = 2 * k + 1 - samples_; // in half ticks: odd about the middle in every bit
    const double window = 0.5 * (1 + std::cos(pi * from_middle / samples_));
    return amplitude * window * std::sin(pi * frequency_ * tick_ * from_middle);
  }

private:
  int samples_, next_ = 1 << 30;
  double tick_, frequency_;
  Eigen::Vector3d direction_ = Eigen::Vector3d::Zero();
};

} // namespace haptic_sculpt

#endif
