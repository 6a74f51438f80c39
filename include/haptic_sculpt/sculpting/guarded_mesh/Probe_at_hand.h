// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Probe.h>
#include <haptic_sculpt/sculpting/finding/find_face_within.h>
#include <haptic_sculpt/sculpting/finding/is_inside.h>
#include <haptic_sculpt/sculpting/guarded_mesh/Hand.h>

#include <optional>
#include <vector>

namespace haptic_sculpt::internal {

/// What moves probes: a hand that holds no vertex. What it has looked up, and the contacts, are carried on where the
/// last drag of a probe ended at the place of this one and the mesh is the same.
template <class Mesh, class Broad_phase, class Traits>
class Probe_at_hand {
public:
  Probe_at_hand(const Mesh& mesh, Broad_phase& broad_phase, const Face_corners<Mesh>& corners, const Traits& traits,
                Mesh_watch<Mesh>& watch, Filter_counters& counters)
      : mesh_(&mesh)
      , broad_phase_(&broad_phase)
      , counters_(&counters)
      , hand_(mesh, broad_phase, corners, traits, watch) {}

  void reserve(std::size_t valence, std::size_t faces) {
    hand_.reserve(valence, faces);
    near_.reserve(faces);
  }

  /// The next drag looks everything up, and begins without contacts.
  void let_go() noexcept { hand_.let_go(); }

  /// Why no probe may begin at p; nothing where one may. \param largest_coordinate of the mesh
  std::optional<Refusal<Mesh>> refuse(const Coordinates& p, Probe_start start, const Clearance_rule& clearance,
                                      double largest_coordinate) {
    if (const auto f = find_face_within(*mesh_, *broad_phase_, p, clearance, largest_coordinate, near_); f.is_valid()) {
      const auto corners = corners_of_face(*mesh_, f);
      return Refusal<Mesh>{Refusal_reason::too_near, {corners[0], corners[1], corners[2]}};
    }
    if (start == Probe_start::outside && is_inside(*mesh_, *broad_phase_, p, *counters_, near_))
      return Refusal<Mesh>{Refusal_reason::inside, {}};
    return std::nullopt;
  }

  /// \param changes of the mesh by now \throw Mesh_changed
  template <class Point>
  Drag_result<Mesh> drag(const Coordinates& source, const Coordinates& target, std::vector<Point>* path,
                         const Drag_parameters& parameters, double delta, std::uint64_t changes) {
    if (!hand_.is_ready() || place_ != source || changes_ != changes)
      hand_.take_point();
    Drag_result<Mesh> result;
    settle_result(source, target, target, result); // where there is no way to go
    place_ = source == target ? target : hand_.move(source, target, parameters, delta, result);
    changes_ = changes;
    if (path != nullptr)
      hand_.write_path(source, place_, *path);
    hand_.check_candidates();
    return result;
  }

private:
  const Mesh* mesh_;
  Broad_phase* broad_phase_;
  Filter_counters* counters_;
  Hand<Mesh, Broad_phase, Traits> hand_;
  std::vector<typename Mesh::Face_index> near_; ///< kept to allocate no more
  Coordinates place_{};                         ///< where the last probe was left
  std::uint64_t changes_ = 0;                   ///< of the mesh, by then
};

} // namespace haptic_sculpt::internal
