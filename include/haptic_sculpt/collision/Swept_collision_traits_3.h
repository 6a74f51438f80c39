// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/Compare_time_3.h>
#include <haptic_sculpt/collision/Sweep_3.h>

namespace haptic_sculpt {

/// The exact questions about one vertex moving along a straight segment while all else stands still: the model of the
/// concept SweptCollisionTraits_3 that is the default everywhere.
///
/// Every answer is a sign of a polynomial in the input doubles: no tolerance, no root finding, no time step. All sets
/// are closed: touching is a hit. Guarantees and their derivation: doc/proofs/exact_sweeps.md.
///
/// \tparam K a CGAL kernel with `FT` = double.
/// \tparam Counters `Filter_counters` to learn how many signs left each filter stage; by default nothing is counted.
///
/// Thread-safe, except that all objects made by one traits share its counters.
template <class K, class Counters = No_filter_counters>
struct Swept_collision_traits_3 {
  static_assert(std::is_same<typename K::FT, double>::value,
                "Swept_collision_traits_3: the kernel must have double coordinates, e.g. "
                "Exact_predicates_inexact_constructions_kernel");

  using Kernel = K;                                                            ///< as given; no part of the concept
  using Point_3 = typename K::Point_3;         ///< of the kernel; its coordinates are doubles
  using Impact_3 = haptic_sculpt::Impact_3<K>; ///< what the three sweeps give; holds its points
  using Vertex_face_sweep_3 =
      haptic_sculpt::Vertex_face_sweep_3<K, Counters>; ///< of the moving vertex and a still face
  using Edge_edge_sweep_3 = haptic_sculpt::Edge_edge_sweep_3<K, Counters>;     ///< of a moving and a still edge
  using Face_vertex_sweep_3 = haptic_sculpt::Face_vertex_sweep_3<K, Counters>; ///< of a moving face and a still vertex
  using Compare_time_3 = haptic_sculpt::Compare_time_3<K, Counters>;           ///< which of two impacts comes first

  /// \param counters where to count filter stages; must outlive this and the objects made by it.
  explicit Swept_collision_traits_3(Counters* counters = nullptr) : counters_(counters) {}

  /// Counts where this does.
  Vertex_face_sweep_3 vertex_face_sweep_3_object() const {
    return Vertex_face_sweep_3(counters_);
  }
  /// Counts where this does.
  Edge_edge_sweep_3 edge_edge_sweep_3_object() const {
    return Edge_edge_sweep_3(counters_);
  }
  /// Counts where this does.
  Face_vertex_sweep_3 face_vertex_sweep_3_object() const {
    return Face_vertex_sweep_3(counters_);
  }
  Compare_time_3 compare_time_3_object() const { return Compare_time_3(counters_); } ///< Counts where this does.

private:
  Counters* counters_;
};

namespace internal {

/// In the place of a Rounding_to_nearest where the caller has one: to ask for the mode takes a tenth of a sweep.
struct Mode_is_set {};

/// A functor of traits for callers under a Rounding_to_nearest. One that is not ours is taken as it is.
template <class Functor>
struct In_set_mode {
  using type = Functor;
};
template <Impact_feature feature, class K, class Counters>
struct In_set_mode<Sweep_3<feature, K, Counters>> {
  using type = Sweep_3<feature, K, Counters, Mode_is_set>;
};
template <class K, class Counters>
struct In_set_mode<Compare_time_3<K, Counters>> {
  using type = Compare_time_3<K, Counters, Mode_is_set>;
};

/// `impact.time_bounds()` for the same callers.
template <class Impact>
std::pair<double, double> time_bounds_in_set_mode(const Impact& impact) {
  return impact.time_bounds();
}
template <class K>
std::pair<double, double> time_bounds_in_set_mode(const Impact_3<K>& impact) {
  return filtered_time(impact.coordinates(), impact.verdict());
}

} // namespace internal
} // namespace haptic_sculpt
