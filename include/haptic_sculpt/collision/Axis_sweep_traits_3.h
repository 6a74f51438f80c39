// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/Degenerate_face_axis_sweep_3.h>
#include <haptic_sculpt/collision/Edge_edge_axis_sweep_3.h>
#include <haptic_sculpt/collision/Vertex_face_axis_sweep_3.h>

namespace haptic_sculpt {

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
