// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/collision/arithmetic/sweep_time.h>

#include <CGAL/enum.h>

#include <type_traits>

namespace haptic_sculpt {

/// The pair of features that meet: what moves, on what stands still.
enum class Impact_feature : std::uint8_t {
  vertex_face, ///< the moving vertex, on a face
  edge_edge,   ///< an edge at the moving vertex, on an edge
  face_vertex  ///< a face at the moving vertex, on a vertex
};

/// "vertex-face", "edge-edge" or "face-vertex".
inline const char* name_of(Impact_feature feature) {
  constexpr const char* names[] = {"vertex-face", "edge-edge", "face-vertex"};
  return names[static_cast<int>(feature)];
}

/// The first meeting of a moving feature with a static one.
///
/// Made by the sweeps. Holds their five points, so it stays valid whatever becomes of the mesh. Allocates only in
/// `exact_time()` and `tight_time()`, and in `time()` and comparisons where the filter leaves them open and coordinates
/// need GMP integers.
///
/// \tparam K a CGAL kernel with `FT` = double.
template <class K>
class Impact_3 {
  static_assert(
      std::is_same<typename K::FT, double>::value,
      "Impact_3: the kernel must have double coordinates, e.g. Exact_predicates_inexact_constructions_kernel");

public:
  using Point_3 = typename K::Point_3; ///< of the kernel; its coordinates are doubles

  /// \cond internal
  Impact_3(Impact_feature feature, const internal::Sweep_points& points, const internal::Sweep_verdict& verdict)
    : points_(points), verdict_(verdict), feature_(feature) {}
  /// \endcond

  Impact_feature feature() const { return feature_; } ///< Which features meet: those of the sweep that was asked.

  /// Where on the static triangle the moving vertex arrives; exact. \pre feature() == vertex_face
  Triangle_location location() const { return verdict_.location; }

  Point_3 source() const { return point(0); } ///< Where the motion starts: S.
  Point_3 target() const { return point(1); } ///< Where it would end: T.

  /// The three points that do not move, in the order of the functor's arguments: A, B, C; V, A, B; or G, I, A.
  Point_3 static_point(int i) const { return point(2 + i); }

  /// Whether the five points lie in one plane (then the contact plane is not determined by them alone), or the meeting
  /// does not involve the moving vertex; in both cases the time still is the first at which the closed sets meet.
  bool is_flat() const { return verdict_.form != internal::Time_form::plane; }

  /// An interval that contains the time u in [0, 1] at which the features first meet; J(u) = S + u (T - S).
  /// The interval is at most 2^-40 wide. No allocation where the filter gives as much.
  std::pair<double, double> time() const {
    const internal::Rounding_to_nearest rounding;
    return internal::enclosed_time(points_, verdict_);
  }

  /// An interval that contains the time, as the filter gives it: at constant cost and without allocation, but wider
  /// than [0, 1] where the filter knows nothing.
  std::pair<double, double> time_bounds() const {
    const internal::Rounding_to_nearest rounding;
    return internal::filtered_time(points_, verdict_);
  }

  /// The same as time(), with neighbouring doubles (or one double) as ends. Allocates.
  std::pair<double, double> tight_time() const {
    const internal::Rounding_to_nearest rounding;
    return internal::tight_time(points_, verdict_);
  }

  /// The time as a GMP rational in lowest terms. Allocates.
  mpq_class exact_time() const {
    const internal::Rounding_to_nearest rounding; // subnormal numbers count
    return internal::exact_time(points_, verdict_);
  }

  /// Whether the time is exactly 0.
  bool is_at_start() const {
    const internal::Rounding_to_nearest rounding;
    No_filter_counters uncounted;
    return internal::compare_times(points_, verdict_, points_, internal::Sweep_verdict(), uncounted) == 0;
  }

  /// Compares the times, exactly, whatever the features.
  friend CGAL::Comparison_result compare_time(const Impact_3& a, const Impact_3& b) {
    const internal::Rounding_to_nearest rounding;
    No_filter_counters uncounted;
    return static_cast<CGAL::Comparison_result>(
        internal::compare_times(a.points_, a.verdict_, b.points_, b.verdict_, uncounted));
  }

  /// \cond internal
  const internal::Sweep_points& coordinates() const { return points_; }
  const internal::Sweep_verdict& verdict() const { return verdict_; }
  /// \endcond

private:
  Point_3 point(int i) const { return Point_3(points_[i][0], points_[i][1], points_[i][2]); }

  internal::Sweep_points points_;
  internal::Sweep_verdict verdict_;
  Impact_feature feature_;
};

} // namespace haptic_sculpt
