// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a result contradicts itself: the one list of what its members have to do with each other.
#pragma once

#include <haptic_sculpt/sculpting/Drag_result.h>

#include <cmath>
#include <limits>
#include <vector>

namespace haptic_sculpt::test {

/// What is wrong with the result of a drag from `source` to `target`, or null. \param path where it was reported, else
/// null \param limit of the work
template <class Mesh, class Point = typename Mesh::Point>
const char* contradiction(const Drag_result<Mesh>& r, const Point& source, const Point& target,
                          const std::vector<Point>* path = nullptr,
                          std::size_t limit = std::numeric_limits<std::size_t>::max()) {
  if (r.reached != (r.end == Drag_end::reached))
    return "reached is not end == reached";
  if (r.end == Drag_end::stale || r.end == Drag_end::refused)
    return r.legs != 0 || (path != nullptr && path->size() > 1) ? "legs of a drag that was not made" : nullptr;
  if (r.reached != (r.position == target))
    return "reached is not position == target";
  if ((r.legs > 0) != (r.position != source))
    return "there are legs without a way, or a way without legs";
  if (path != nullptr) {
    if (path->size() != static_cast<std::size_t>(r.legs) + 1)
      return "the path has not one point more than legs";
    if (path->front() != source || path->back() != r.position)
      return "the path does not lead from the start to the position";
  }
  if (r.end == Drag_end::no_progress && r.position != source)
    return "no progress, but another place";
  if (r.end == Drag_end::no_progress && !r.contacts.empty())
    return "no progress, but contacts that hold it";
  if (r.end == Drag_end::leg_limit && r.legs == 0)
    return "the limit of legs, without legs";
  if (r.end == Drag_end::held && r.contacts.empty())
    return "held by nothing";
  if (r.reached && (!r.contacts.empty() || r.kkt_residual != 0 || r.stop_error != 0 || r.stop_error_along_path != 0))
    return "reached, but something holds it";
  if (!r.reached && r.contacts.empty() && r.kkt_residual != 1)
    return "nothing resists, but the residual is not 1";
  if (!(r.kkt_residual >= 0 && r.kkt_residual <= 1) || !(r.stop_error >= 0) || !(r.stop_error_along_path >= 0))
    return "a residual out of [0, 1], or an error below 0";
  if (r.work > limit)
    return "work beyond its limit";
  return nullptr;
}

} // namespace haptic_sculpt::test
