// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Contact_3.h>
#include <haptic_sculpt/sculpting/Response.h>

#include <boost/container/small_vector.hpp>

namespace haptic_sculpt {

/// Why a drag ended.
enum class Drag_end : std::uint8_t {
  reached, ///< it is at the target
  held, ///< contacts hold it where it is; a slide has found no free way nearer (doc/use/drags.md, "What a drag says")
  no_progress, ///< it did not move, and no contact is known that explains it: too little room for the clearance
  leg_limit,   ///< as many legs were made as one drag may make; the next drag to the same target goes on
  refused,     ///< a probe that could not begin where it is
  stuck,       ///< the slide gave up on the way: nothing is said about what is nearer
  work_limit,  ///< as much work was done as one drag may do; of a slide the next one to a near target goes on
  stale ///< the vertex has been removed, or another Grab has the hand; a probe's mesh has changed: nothing was moved
};

/// The name used in reports: "reached", "held", "no-progress", "leg-limit", "refused", "stuck", "work-limit"
/// or "stale".
inline const char* name_of(Drag_end end) {
  constexpr const char* names[] = {"reached", "held",  "no-progress", "leg-limit",
                                   "refused", "stuck", "work-limit",  "stale"};
  return names[static_cast<int>(end)];
}

/// The outcome of a drag. A blocked drag is a result like any other.
template <class Mesh>
struct Drag_result {
  /// This many contacts are held without an allocation. A stop reports all that come exactly first, a slide carries 32
  /// at most; they are more only where as many features meet in one point, or nearly.
  static constexpr std::size_t usual_contacts = 16;
  /// Like a std::vector.
  using Contacts = boost::container::small_vector<Contact_3<Mesh>, usual_contacts>;

  /// Of a vertex that is not there any more, or is not in this hand. \param place where this hand left it
  static Drag_result stale_at(const typename Mesh::Point& place) {
    Drag_result result;
    result.position = place;
    result.end = Drag_end::stale;
    return result;
  }

  typename Mesh::Point position;             ///< where the vertex is now; of a stale Grab, where that Grab had it last
  bool reached = false; ///< whether that is the target, as numbers: +0 is -0, and `end` is Drag_end::reached
  Drag_end end = Drag_end::no_progress;      ///< why the drag ended
  Contacts contacts; ///< what holds it: of a stop in an order of the elements, of a slide as they were met
  int legs = 0; ///< straight motions, each proven, from where it was to `position`; 0 where that is the same
  /// The distance of a stopped vertex from the nearest contact plane, in the unit of the coordinates; of a contact of
  /// the delta rule, from where the altitude would be too low, to first order; where all contacts are flat impacts, of
  /// a stop as stop_error_along_path, of a slide from the wall. 0 when nothing stopped it. Of the last leg.
  double stop_error = 0;
  double stop_error_along_path = 0; ///< a stop's distance from the exact point of impact, along the path
  std::size_t work = 0;    ///< pairs decided and candidates looked up: what a bound on the work counts; no more than it
  double kkt_residual = 0; ///< |d - nearest point of the cone of pushes| / |d|, d = target - position; 0 if reached
};

} // namespace haptic_sculpt
