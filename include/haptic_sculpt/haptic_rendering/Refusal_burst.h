// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace haptic_sculpt {

/// What an edit that is refused feels like: a short buzz, whole cycles of about 120 Hz under a Hann window.
///
/// Its samples are even about its middle and sum to 0, because the window spreads a whole number of cycles, 2 or more,
/// over neighbouring numbers of cycles only. So neither their sum nor their first moment is left: a free mass comes to
/// rest where it began. On the way it moves by the amplitude over mass and frequency squared, and motors at low rates
/// cannot render a high frequency; the amplitude is as small as it takes to keep that way short.
class Refusal_burst {
public:
  static constexpr double frequency = 120;   ///< Hz, about where fingers feel least amplitudes
  static constexpr double duration = 0.05;   ///< s
  static constexpr double amplitude = 1;     ///< N, at most
  static constexpr double farthest = 0.9e-4; ///< m: how far a free handle may move meanwhile

  /// \param tick s, at most a quarter of the duration; a cycle has at least three ticks. Costs a walk over the samples.
  explicit Refusal_burst(double tick)
      : samples_(std::max(6, static_cast<int>(std::lround(duration / tick))))
      , cycles_(std::clamp(static_cast<int>(std::lround(frequency * samples_ * tick)), 2, samples_ / 3))
      , way_(way_of_unit_mass(tick)) {}

  /// Begins along a direction; one under way goes on in its own.
  /// \param mobility how fast the free handle is accelerated there by a newton, 1/kg
  void begin(const Eigen::Vector3d& direction, double mobility) {
    if (!is_over())
      return;
    const double share = std::isfinite(mobility) ? std::fmin(1.0, farthest / (way_ * mobility)) : 0.0;
    peak_ = share * direction.normalized(), next_ = 0;
  }
  void cut() { next_ = samples_; } ///< Ends one under way: what is left of it is not felt.
  bool is_over() const { return next_ >= samples_; } ///< whether none is under way

  /// The force of the next tick, N.
  Eigen::Vector3d next() {
    if (is_over())
      return Eigen::Vector3d::Zero();
    return sample(next_++) * peak_;
  }

  int samples() const { return samples_; } ///< ticks that a burst takes, at least 6
  /// N, for the largest amplitude. \pre 0 <= k < samples()
  double sample(int k) const {
    constexpr double pi = EIGEN_PI;
    const int from_middle = std::abs(2 * k + 1 - samples_); // in half ticks: even about the middle in every bit
    const double window = 0.5 * (1 + std::cos(pi * from_middle / samples_));
    return amplitude * window * std::cos(pi * cycles_ * from_middle / samples_);
  }

private:
  int samples_, cycles_, next_ = 1 << 30;
  double way_; ///< how far the largest amplitude, held tick by tick, moves a mass of 1 kg, m
  Eigen::Vector3d peak_ = Eigen::Vector3d::Zero();

  double way_of_unit_mass(double tick) const {
    double place = 0, velocity = 0, farthest_place = 0;
    for (int k = 0; k < samples_; ++k) {
      const double force = sample(k), later = velocity + force * tick;
      if (velocity * later < 0) // it turns within the tick
        farthest_place = std::fmax(farthest_place, std::abs(place - velocity * velocity / (2 * force)));
      place += (velocity + later) / 2 * tick, velocity = later;
      farthest_place = std::fmax(farthest_place, std::abs(place));
    }
    return farthest_place;
  }
};

} // namespace haptic_sculpt
