// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/Compare_time_3.h>
#include <haptic_sculpt/collision/Sweep_3.h>

namespace haptic_sculpt::internal {

/// In the place of a Rounding_to_nearest where the caller has one: to ask for the mode takes a tenth of a sweep.
struct Mode_is_set {};

/// A functor of traits for callers under a Rounding_to_nearest. One that is not ours is taken as it is.
template <class Functor>
struct In_set_mode {
  using type = Functor;
};
template <Impact_feature feature, class K, class Counters>
struct In_set_mode<Sweep_3<feature, K, Counters>> {
  using type = Sweep_3<feature, K, Counters, Mode_is_set>;
};
template <class K, class Counters>
struct In_set_mode<Compare_time_3<K, Counters>> {
  using type = Compare_time_3<K, Counters, Mode_is_set>;
};

/// `impact.time_bounds()` for the same callers.
template <class Impact>
std::pair<double, double> time_bounds_in_set_mode(const Impact& impact) {
  return impact.time_bounds();
}
template <class K>
std::pair<double, double> time_bounds_in_set_mode(const Impact_3<K>& impact) {
  return filtered_time(impact.coordinates(), impact.verdict());
}

} // namespace haptic_sculpt::internal
