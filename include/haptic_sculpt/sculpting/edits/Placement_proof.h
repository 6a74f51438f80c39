// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_PLACEMENT_PROOF_H
#define HAPTIC_SCULPT_SCULPTING_PLACEMENT_PROOF_H

#include <haptic_sculpt/sculpting/Edit_result.h>
#include <haptic_sculpt/sculpting/finding/find_face_within.h>
#include <haptic_sculpt/sculpting/finding/is_inside.h>

namespace haptic_sculpt {
namespace internal {

/// Decides whether a probe may be put somewhere, whatever is on the way (doc/probes.md).
template <class Mesh, class Broad_phase>
class Placement_proof {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Refused = std::optional<Refusal<Mesh>>;

  Placement_proof(const Mesh& mesh, Broad_phase& broad_phase, Filter_counters& counters)
      : mesh_(&mesh), broad_phase_(&broad_phase), counters_(&counters) {}

  /// \param largest_coordinate bounds those of all vertices
  Refused refuse(Vertex_index probe, const Coordinates& p, const Clearance_rule& rule, double largest_coordinate) {
    if (!mesh_->is_isolated(probe))
      return Refusal<Mesh>{Refusal_reason::not_isolated, {probe}};
    if (const auto f = find_face_within(*mesh_, *broad_phase_, p, rule, largest_coordinate, faces_); f.is_valid()) {
      const auto corners = corners_of_face(*mesh_, f);
      return Refusal<Mesh>{Refusal_reason::too_near, {corners[0], corners[1], corners[2]}};
    }
    if (is_inside(*mesh_, *broad_phase_, p, *counters_, faces_))
      return Refusal<Mesh>{Refusal_reason::inside, {}};
    return std::nullopt;
  }

  void reserve(std::size_t usual_candidates) { faces_.reserve(usual_candidates); }

private:
  const Mesh* mesh_;
  Broad_phase* broad_phase_;
  Filter_counters* counters_;
  std::vector<typename Mesh::Face_index> faces_;
};

} // namespace internal
} // namespace haptic_sculpt

#endif
