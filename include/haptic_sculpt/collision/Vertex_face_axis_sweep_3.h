// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_COLLISION_VERTEX_FACE_AXIS_SWEEP_3_H
#define HAPTIC_SCULPT_COLLISION_VERTEX_FACE_AXIS_SWEEP_3_H

#include <haptic_sculpt/collision/arithmetic/axis_sweep.h>
#include <haptic_sculpt/collision/arithmetic/sweep_points.h>

#include <CGAL/assertions.h>

#include <type_traits>

namespace haptic_sculpt {

/// Does the point `v` meet the closed triangle `a`, `b`, `c` at some time while all four move along one coordinate
/// axis? The triangle may be flat, on edge, a segment or a point.
///
/// Exact for all finite doubles: signs of the coordinates given, no time is worked out.
/// \tparam K a CGAL kernel with `FT` = double \tparam Counters where filter failures are counted
/// Cost: constant; 4 two-dimensional orientations, and 2 in space where the point is over the triangle.
template <class K, class Counters = No_filter_counters>
class Vertex_face_axis_sweep_3 {
  static_assert(std::is_same<typename K::FT, double>::value,
                "Vertex_face_axis_sweep_3: the kernel must have double coordinates");

public:
  using Point_3 = typename K::Point_3; ///< of the kernel; its coordinates are doubles
  using result_type = bool;            ///< of a call, by the name that CGAL's functors give it

  /// \param counters where to count, if anywhere; has to outlive this
  explicit Vertex_face_axis_sweep_3(Counters* counters = nullptr) : counters_(counters) {}

  /// \param axis 0, 1 or 2: the coordinate that changes, at constant speed \param v,a,b,c at the start
  /// \param heights their coordinates along the axis at the end, in the same order
  /// \pre all coordinates are finite
  result_type operator()(int axis, const Point_3& v, const Point_3& a, const Point_3& b, const Point_3& c,
                         const std::array<double, 4>& heights) const {
    using namespace internal;
    const Axis_motion<4> motion(axis, {coordinates(v), coordinates(a), coordinates(b), coordinates(c)}, heights);
    CGAL_precondition(0 <= axis && axis < 3 && motion.are_finite());
    Counters ignored;
    return Axis_sweep<4, Counters>(motion, counters_ != nullptr ? *counters_ : ignored)
        .do_vertex_and_face_meet(0, 1, 2, 3);
  }

private:
  Counters* counters_;
};

} // namespace haptic_sculpt

#endif
