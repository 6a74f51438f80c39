// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/finding_and_placing.h>

#include <array>
#include <optional>

namespace haptic_sculpt::internal {

/// Where a probe may begin that has no place since a vertex was let go: a little off the surface; from a pit too thin
/// for that, behind what is around it, along the vertex's normal and then along the last push. One place a tick.
class Probe_placement {
public:
  /// \param place of the vertex then, and its normal
  Probe_placement(const Eigen::Vector3d& place, const Eigen::Vector3d& normal)
      : place_(place), away_(normal), from_(place) {}

  const Eigen::Vector3d& place() const { return place_; }             ///< of the vertex when it was let go
  bool is_over() const { return tried_ == near + 2 * most_surfaces; } ///< there is no other place to be tried

  /// The next one, if this try finds one. \param reach, scale in the scene: of the tool, and of a metre
  template <class Sculptor>
  std::optional<Eigen::Vector3d> next(Sculptor& sculptor, double reach, double scale,
                                      const Eigen::Vector3d& last_push) {
    using Point = typename Sculptor::Point;
    const int tried = tried_++;
    if (tried < near)
      return within_range(place_ + shares[tried] * reach * away_);
    const bool is_second = tried >= near + most_surfaces;
    const Eigen::Vector3d& direction = is_second ? last_push : away_;
    if (tried == near + most_surfaces)
      from_ = place_;
    const auto hit =
        sculptor.first_hit(point_of<Point>(from_), point_of<Point>(within_range(place_ + 4 * scale * direction)));
    if (!hit) {
      tried_ = near + (is_second ? 2 : 1) * most_surfaces;
      return std::nullopt;
    }
    return from_ = within_range(vector_of(hit->point) + 0.2 * reach * direction);
  }

private:
  static constexpr std::array<double, 3> shares{0.02, 0.2, 1.0}; ///< of the reach
  static constexpr int near = shares.size(), most_surfaces = 16; ///< a hand that is deeper inside comes out by itself

  Eigen::Vector3d place_, away_, from_; ///< from_: behind the last surface that was met
  int tried_ = 0;                       ///< places
};

} // namespace haptic_sculpt::internal
