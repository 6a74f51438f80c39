// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_COLLISION_DEGENERATE_FACE_AXIS_SWEEP_3_H
#define HAPTIC_SCULPT_COLLISION_DEGENERATE_FACE_AXIS_SWEEP_3_H

#include <haptic_sculpt/collision/arithmetic/axis_sweep.h>
#include <haptic_sculpt/collision/arithmetic/sweep_points.h>

#include <CGAL/assertions.h>

#include <type_traits>

namespace haptic_sculpt {

/// Do the corners of a triangle lie on one line at some time while they move along one coordinate axis?
/// Only where they lie in a plane along that axis can that come about by the motion.
///
/// Exact for all finite doubles: signs of the coordinates given, no time is worked out.
/// \tparam K a CGAL kernel with `FT` = double \tparam Counters where filter failures are counted
/// Cost: constant; 3 two-dimensional orientations at most.
template <class K, class Counters = No_filter_counters>
class Degenerate_face_axis_sweep_3 {
  static_assert(std::is_same<typename K::FT, double>::value,
                "Degenerate_face_axis_sweep_3: the kernel must have double coordinates");

public:
  using Point_3 = typename K::Point_3; ///< of the kernel; its coordinates are doubles
  using result_type = bool;            ///< of a call, by the name that CGAL's functors give it

  /// \param counters where to count, if anywhere; has to outlive this
  explicit Degenerate_face_axis_sweep_3(Counters* counters = nullptr) : counters_(counters) {}

  /// \param axis 0, 1 or 2: the coordinate that changes, at constant speed \param a,b,c at the start
  /// \param heights their coordinates along the axis at the end
  /// \pre all coordinates are finite
  result_type operator()(int axis, const Point_3& a, const Point_3& b, const Point_3& c,
                         const std::array<double, 3>& heights) const {
    using namespace internal;
    const Axis_motion<3> motion(axis, {coordinates(a), coordinates(b), coordinates(c)}, heights);
    CGAL_precondition(0 <= axis && axis < 3 && motion.are_finite());
    Counters ignored;
    return Axis_sweep<3, Counters>(motion, counters_ != nullptr ? *counters_ : ignored).is_face_degenerate(0, 1, 2);
  }

private:
  Counters* counters_;
};

} // namespace haptic_sculpt

#endif
