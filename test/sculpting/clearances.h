// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting.h>

namespace haptic_sculpt::test {

/// The largest clearance that a drag to `target` may keep from anything.
template <class Sculptor>
double largest_clearance(const Sculptor& sculptor, const typename Sculptor::Point& target) {
  double largest = sculptor.clearance(target);
  for (const auto v : sculptor.mesh().vertices())
    largest = std::fmax(largest, sculptor.clearance(sculptor.mesh().point(v)));
  return largest;
}

/// The largest that this drag keeps from its contacts where it has ended.
template <class Sculptor>
double clearance_kept(const Sculptor& sculptor, const typename Sculptor::Result& result) {
  double largest = sculptor.clearance(result.position);
  for (const auto& contact : result.contacts)
    for (const auto& p : contact.plane)
      largest = std::fmax(largest, sculptor.clearance({p[0], p[1], p[2]}));
  return largest;
}

} // namespace haptic_sculpt::test
