// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Drag_result.h>

namespace haptic_sculpt::internal {

/// The one place where a result is made to say one thing: what follows from where a drag began, where it ended and
/// where it was to end is derived from these, whatever the response has written. \pre contacts, legs, stop errors and
/// `end` are as the response tells, `end` for the case that the target was not reached
///
/// Coordinates are compared as numbers: +0 and -0 are one place.
template <class Mesh>
void settle_result(const Coordinates& source, const Coordinates& target, const Coordinates& end,
                   Drag_result<Mesh>& result) {
  result.position = typename Mesh::Point(end[0], end[1], end[2]);
  result.reached = end == target;
  if (end == source)
    result.legs = 0; // whatever was tried, or gone and come back
  if (result.reached) {
    result.end = Drag_end::reached;
    result.contacts.clear(); // nothing holds it
    result.stop_error = result.stop_error_along_path = 0;
    return;
  }
  const bool explains_nothing = result.end == Drag_end::held && result.contacts.empty();
  if (result.end == Drag_end::reached || explains_nothing)
    result.end = Drag_end::stuck;
  if (end == source &&
      (result.end == Drag_end::leg_limit || (result.end == Drag_end::stuck && result.contacts.empty())))
    result.end = Drag_end::no_progress;
  else if (end != source && result.end == Drag_end::no_progress)
    result.end = Drag_end::stuck;
}

} // namespace haptic_sculpt::internal
