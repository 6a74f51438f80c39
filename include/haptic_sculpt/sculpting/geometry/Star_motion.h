// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/geometry/vector_3.h>
#include <haptic_sculpt/surface/Box_3.h>

#include <limits>

namespace haptic_sculpt::internal {

/// The straight motion of a star's centre, as far as it is of interest.
class Star_motion {
public:
  using Coordinates = std::array<double, 3>;

  Star_motion(const Coordinates& source, const Coordinates& target)
      : Star_motion(source, target, Box_3(source).include(target)) {}
  /// \param path holds the way as far as it is of interest
  Star_motion(const Coordinates& source, const Coordinates& target, const Box_3& path)
      : source_(source), target_(target), path_(path) {}

  const Coordinates& source() const { return source_; }
  const Coordinates& target() const { return target_; }

  /// Holds the way as far as it is of interest.
  const Box_3& path() const { return path_; }

  /// About the vector of that way, in a unit in which its share of the whole is no subnormal number.
  Vector way(double unit) const { return scaled(scaled(minus(target_, source_), unit), until_); }

  /// Only what happens up to `time`, a fraction of the way, is of interest from now on.
  void shorten(double time) {
    if (!(time < until_))
      return;
    until_ = time;
    for (int i = 0; i < 3; ++i) {
      // The product and the two sums round by less than 2^-50 of both ends together, in any rounding mode.
      const double slack = 0x1p-49 * (std::abs(source_[i]) + std::abs(target_[i])) + std::numeric_limits<double>::min();
      const double end = source_[i] + until_ * (target_[i] - source_[i]);
      // An end that is no number shortens nothing.
      if (target_[i] > source_[i])
        path_.upper[i] = std::fmin(path_.upper[i], end + slack);
      else
        path_.lower[i] = std::fmax(path_.lower[i], end - slack);
    }
  }

private:
  Coordinates source_, target_;
  double until_ = 1;
  Box_3 path_;
};

} // namespace haptic_sculpt::internal
