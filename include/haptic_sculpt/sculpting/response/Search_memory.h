// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/geometry/clearance.h>
#include <haptic_sculpt/sculpting/geometry/vector_3.h>

namespace haptic_sculpt::internal {

/// Whether a search for either finds the same: a target is nearer by as much as it has moved at most, and clearances
/// can feign more.
inline bool are_one_target(const Vector& target, const Vector& other, const Slide_lengths& lengths) {
  return length(minus(target, other)) <= 4 * lengths.clearance;
}

/// Where a search has found nothing, and for which target.
class Search_memory {
public:
  /// Something has changed: where nothing was found there may be something now.
  void forget() { is_known_ = false; }
  void note(const Vector& place, const Vector& target) {
    is_known_ = true;
    place_ = place;
    target_ = target;
  }

  bool is_at(const Vector& place, const Slide_lengths& lengths) const {
    return is_known_ && length(minus(place, place_)) <= lengths.settled();
  }
  bool holds(const Vector& place, const Vector& target, const Slide_lengths& lengths) const {
    return is_at(place, lengths) && are_one_target(target, target_, lengths);
  }
  const Vector& target() const { return target_; } ///< that was noted last

private:
  bool is_known_ = false;
  Vector place_{}, target_{};
};

} // namespace haptic_sculpt::internal
