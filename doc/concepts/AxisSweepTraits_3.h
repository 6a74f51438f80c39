// SPDX-License-Identifier: GPL-3.0-or-later
// For the reference only: what is asked of a template parameter. It is not compiled.

/// The concept of what decides motions along one coordinate axis. Has model haptic_sculpt::Axis_sweep_traits_3, which is exact.
///
/// All points go at once from where they are to another coordinate along the axis, each at its own constant speed. The first two
/// functors say whether two features meet at some time, the third whether a face becomes degenerate. All sets are closed.
class AxisSweepTraits_3 {
public:
  /// The mesh's point, of a kernel with `FT` = double.
  typedef unspecified_type Point_3;

  /// `f(axis, v, a, b, c, heights)` returns a `bool`: whether the point v meets the triangle abc. `heights` is a
  /// `std::array<double, 4>`: the coordinates along the axis at the end, in the order of the points.
  typedef unspecified_type Vertex_face_axis_sweep_3;
  /// `f(axis, a, b, c, d, heights)` returns a `bool`: whether the segments ab and cd meet.
  typedef unspecified_type Edge_edge_axis_sweep_3;
  /// `f(axis, a, b, c, heights)`, with three heights, returns a `bool`: whether the corners lie on one line at some time.
  typedef unspecified_type Degenerate_face_axis_sweep_3;

  /// \name Functors
  ///@{
  Vertex_face_axis_sweep_3 vertex_face_axis_sweep_3_object() const;         ///< The functor of this name.
  Edge_edge_axis_sweep_3 edge_edge_axis_sweep_3_object() const;             ///< The functor of this name.
  Degenerate_face_axis_sweep_3 degenerate_face_axis_sweep_3_object() const; ///< The functor of this name.
  ///@}
};
