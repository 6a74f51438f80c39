// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/collision/arithmetic/axis_sweep.h>
#include <haptic_sculpt/collision/arithmetic/Sweep_verdict.h>

#include <CGAL/assertions.h>

#include <type_traits>

namespace haptic_sculpt {
namespace internal {

/// What the three sweeps along an axis have in common. Exact for all finite doubles: signs of the coordinates given, no
/// time is worked out.
template <std::size_t points, class K, class Counters>
class Axis_sweep_3 {
  static_assert(std::is_same<typename K::FT, double>::value,
                "sweeps along an axis: the kernel must have double coordinates");

public:
  using Point_3 = typename K::Point_3; ///< of the kernel; its coordinates are doubles
  using result_type = bool;            ///< of a call, by the name that CGAL's functors give it
  /// \param counters where to count, if anywhere; has to outlive this
  explicit Axis_sweep_3(Counters* counters = nullptr) : counters_(counters) {}

protected:
  template <class Decide>
  bool decide(int axis, const std::array<Coordinates, points>& start, const std::array<double, points>& heights,
              const Decide& question) const {
    const Rounding_to_nearest rounding;
    const Axis_motion<points> motion(axis, start, heights);
    CGAL_precondition(0 <= axis && axis < 3 && motion.are_finite());
    Counters ignored;
    return question(Axis_sweep<points, Counters>(motion, counters_ != nullptr ? *counters_ : ignored));
  }

private:
  Counters* counters_;
};

} // namespace internal

/// Does the point `v` meet the closed triangle `a`, `b`, `c` at some time while all four move along one coordinate
/// axis? The triangle may be flat, on edge, a segment or a point. Exact for all finite doubles.
/// \tparam K a CGAL kernel with `FT` = double \tparam Counters where filter failures are counted
/// Cost: constant; 4 two-dimensional orientations, and 2 in space where the point is over the triangle; 10
/// two-dimensional ones at most where all are seen on one line.
template <class K, class Counters = No_filter_counters>
class Vertex_face_axis_sweep_3 : public internal::Axis_sweep_3<4, K, Counters> {
public:
  using Point_3 = typename K::Point_3; ///< of the kernel; its coordinates are doubles
  using internal::Axis_sweep_3<4, K, Counters>::Axis_sweep_3;

  /// \param axis 0, 1 or 2: the coordinate that changes, at constant speed \param v,a,b,c at the start
  /// \param heights their coordinates along the axis at the end, in the same order
  /// \pre all coordinates are finite
  bool operator()(int axis, const Point_3& v, const Point_3& a, const Point_3& b, const Point_3& c,
                  const std::array<double, 4>& heights) const {
    using internal::coordinates;
    return this->decide(axis, {coordinates(v), coordinates(a), coordinates(b), coordinates(c)}, heights,
                        [](const auto& sweep) { return sweep.do_vertex_and_face_meet(0, 1, 2, 3); });
  }
};

/// Do the closed segments `a`, `b` and `c`, `d` meet at some time while all four ends move along one coordinate axis?
/// They may be parallel, collinear, vertical, or points. Exact for all finite doubles.
/// \tparam K a CGAL kernel with `FT` = double \tparam Counters where filter failures are counted
/// Cost: constant; 4 two-dimensional orientations, and 2 in space where they cross as seen along the axis; 12
/// two-dimensional ones at most where all are seen on one line.
template <class K, class Counters = No_filter_counters>
class Edge_edge_axis_sweep_3 : public internal::Axis_sweep_3<4, K, Counters> {
public:
  using Point_3 = typename K::Point_3; ///< of the kernel; its coordinates are doubles
  using internal::Axis_sweep_3<4, K, Counters>::Axis_sweep_3;

  /// \param axis 0, 1 or 2: the coordinate that changes, at constant speed \param a,b,c,d at the start
  /// \param heights their coordinates along the axis at the end, in the same order
  /// \pre all coordinates are finite
  bool operator()(int axis, const Point_3& a, const Point_3& b, const Point_3& c, const Point_3& d,
                  const std::array<double, 4>& heights) const {
    using internal::coordinates;
    return this->decide(axis, {coordinates(a), coordinates(b), coordinates(c), coordinates(d)}, heights,
                        [](const auto& sweep) { return sweep.do_edges_meet(0, 1, 2, 3); });
  }
};

/// Do the corners of a triangle lie on one line at some time while they move along one coordinate axis?
/// Only where they lie in a plane along that axis can that come about by the motion. Exact for all finite doubles.
/// \tparam K a CGAL kernel with `FT` = double \tparam Counters where filter failures are counted
/// Cost: constant; 3 two-dimensional orientations at most.
template <class K, class Counters = No_filter_counters>
class Degenerate_face_axis_sweep_3 : public internal::Axis_sweep_3<3, K, Counters> {
public:
  using Point_3 = typename K::Point_3; ///< of the kernel; its coordinates are doubles
  using internal::Axis_sweep_3<3, K, Counters>::Axis_sweep_3;

  /// \param axis 0, 1 or 2: the coordinate that changes, at constant speed \param a,b,c at the start
  /// \param heights their coordinates along the axis at the end
  /// \pre all coordinates are finite
  bool operator()(int axis, const Point_3& a, const Point_3& b, const Point_3& c,
                  const std::array<double, 3>& heights) const {
    using internal::coordinates;
    return this->decide(axis, {coordinates(a), coordinates(b), coordinates(c)}, heights,
                        [](const auto& sweep) { return sweep.is_face_degenerate(0, 1, 2); });
  }
};

/// The exact questions about features all of whose corners move at once along one coordinate axis, each at its own
/// constant speed: the model of the concept AxisSweepTraits_3.
///
/// An embedded mesh stays embedded in such a motion exactly where no vertex meets a face that it is no corner of, no
/// two edges without a common end meet, and no face becomes degenerate. Derivation: doc/proofs/axis_moves.md.
///
/// \tparam K a CGAL kernel with `FT` = double.
/// \tparam Counters `Filter_counters` to learn how many signs left each filter stage; by default nothing is counted.
///
/// Thread-safe, except that all objects made by one traits share its counters.
template <class K, class Counters = No_filter_counters>
struct Axis_sweep_traits_3 {
  using Kernel = K;                    ///< as given; no part of the concept
  using Point_3 = typename K::Point_3; ///< of the kernel; its coordinates are doubles
  using Vertex_face_axis_sweep_3 = haptic_sculpt::Vertex_face_axis_sweep_3<K, Counters>; ///< of a vertex and a face
  using Edge_edge_axis_sweep_3 = haptic_sculpt::Edge_edge_axis_sweep_3<K, Counters>;     ///< of two edges
  using Degenerate_face_axis_sweep_3 = haptic_sculpt::Degenerate_face_axis_sweep_3<K, Counters>; ///< of one face

  /// \param counters where to count filter stages; must outlive this and the objects made by it.
  explicit Axis_sweep_traits_3(Counters* counters = nullptr) : counters_(counters) {}

  /// Counts where this does.
  Vertex_face_axis_sweep_3 vertex_face_axis_sweep_3_object() const { return Vertex_face_axis_sweep_3(counters_); }
  /// Counts where this does.
  Edge_edge_axis_sweep_3 edge_edge_axis_sweep_3_object() const { return Edge_edge_axis_sweep_3(counters_); }
  /// Counts where this does.
  Degenerate_face_axis_sweep_3 degenerate_face_axis_sweep_3_object() const {
    return Degenerate_face_axis_sweep_3(counters_);
  }

private:
  Counters* counters_;
};

} // namespace haptic_sculpt
