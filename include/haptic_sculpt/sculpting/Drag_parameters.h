// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Response.h>

#include <cstddef>
#include <optional>

namespace haptic_sculpt {

/// How a vertex or a probe is dragged, named and chained: `Drag_parameters().response(Response::stop)`. The last
/// argument of what drags; where it is left out those of the Sculptor hold.
struct Drag_parameters {
  Response response_rule = Response::slide;    ///< see response()
  std::optional<double> clearance_length;      ///< unset: 4 ulp at each contact
  std::optional<std::size_t> work_limit_pairs; ///< unset: a drag takes what it takes
  bool is_once = false;                        ///< see once()

  /// What is done where the way is blocked. Contacts are carried on from drag to drag with the same response only.
  Drag_parameters& response(Response rule) {
    response_rule = rule;
    return *this;
  }
  /// The distance normal to a contact plane that a stop keeps, in the unit of the coordinates. Of use is what is at
  /// least an ulp of the scene's largest coordinate, and at most 1/128 of its extent. Cost: the first drag with another
  /// clearance than the last reads every point.
  Drag_parameters& clearance(std::optional<double> length) {
    clearance_length = length;
    return *this;
  }
  /// Bounds the work, for a loop that has to be in time: after this many pairs decided and candidates looked up the
  /// drag ends as Drag_end::work_limit where it is (doc/use/work.md).
  Drag_parameters& work_limit(std::optional<std::size_t> pairs) {
    work_limit_pairs = pairs;
    return *this;
  }
  /// Whether a vertex is dragged once, and then another. Of a vertex that is in hand it changes nothing. Another one is
  /// then taken for such drags alone: only the points of the star are compared with where they were left, and the next
  /// drag of it that is not for once begins without contacts. It is counted as other work; where the drag ends without
  /// a work limit does not depend on it.
  Drag_parameters& once(bool on = true) {
    is_once = on;
    return *this;
  }
};

} // namespace haptic_sculpt
