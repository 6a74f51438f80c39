// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Edit_result.h>
#include <haptic_sculpt/sculpting/edits/Edit_proof.h>
#include <haptic_sculpt/sculpting/edits/Mesh_watch.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

namespace haptic_sculpt::internal {

/// Decides into which of its neighbours a vertex can be drawn, for the edge between them to collapse
/// (doc/use/edits.md).
template <class Mesh, class Broad_phase>
class Collapse_proof {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;
  using Refused = std::optional<Refusal<Mesh>>;
  using Elements = typename Refusal<Mesh>::Elements;

  Collapse_proof(const Mesh& mesh, Broad_phase& broad_phase, const Face_corners<Mesh>& corners,
                 Filter_counters& counters)
      : mesh_(&mesh), broad_phase_(&broad_phase), corners_of_(&corners), proof_(counters) {}

  const Star<Mesh>& star() const { return star_; }
  const Coordinates& centre() const { return centre_; }

  /// Takes a vertex; refuses what holds whatever the neighbour.
  Refused begin(Vertex_index v) {
    star_.collect(*mesh_, v);
    Mesh_watch<Mesh>::check_faces(*corners_of_, star_.faces);
    centre_ = vertex_coordinates(*mesh_, v);
    if (is_tetrahedron())
      return Refusal<Mesh>{Refusal_reason::tetrahedron, {star_.link.begin(), star_.link.end()}};
    return std::nullopt;
  }

  /// Whether the vertex can be drawn into `star().link[pivot]`.
  Refused refuse(std::size_t pivot, double delta) {
    Elements in_the_way;
    if (!link_condition(pivot, in_the_way))
      return Refusal<Mesh>{Refusal_reason::doubled_edge, in_the_way};
    if (!fan_keeps_delta(pivot, delta, in_the_way))
      return Refusal<Mesh>{Refusal_reason::delta, in_the_way};
    // Each way by itself: the box around a star that was drawn far out may hold a good part of the mesh.
    candidates_.clear();
    broad_phase_->query_star(star_.swept(centre_, star_.link_points[pivot]), candidates_);
    list_.assign(*mesh_, *corners_of_, star_, candidates_, Box_3());
    if (!proof_.can_collapse(star_, list_, centre_, pivot, in_the_way))
      return Refusal<Mesh>{Refusal_reason::blocked, in_the_way};
    return std::nullopt;
  }

  void reserve(std::size_t usual_valence, std::size_t usual_candidates) {
    star_.reserve(usual_valence);
    candidates_.reserve(usual_candidates);
    list_.reserve(usual_valence, usual_candidates);
    proof_.reserve(usual_valence, usual_valence + 3 * usual_candidates, 3 * usual_candidates);
  }

private:
  const Mesh* mesh_;
  Broad_phase* broad_phase_;
  const Face_corners<Mesh>* corners_of_;
  Edit_proof<Mesh, Filter_counters> proof_;
  Star<Mesh> star_;
  Coordinates centre_{};
  Candidate_list<Mesh> list_;
  std::vector<Face_index> candidates_;

  bool is_tetrahedron() const {
    if (star_.valence() != 3)
      return false;
    for (const Vertex_index v : star_.link)
      if (mesh_->degree(v) != 3)
        return false;
    return true;
  }

  /// The centre and the pivot have no common neighbours but the two wings, and are not both of valence 3.
  bool link_condition(std::size_t pivot, Elements& in_the_way) const {
    const Vertex_index apex = star_.link[pivot];
    const std::size_t n = star_.valence(), left = (pivot + 1) % n, right = (pivot + n - 1) % n;
    for (std::size_t i = 0; i < n; ++i)
      if (i != pivot && i != left && i != right && mesh_->halfedge(apex, star_.link[i]).is_valid()) {
        in_the_way = {apex, star_.link[i]};
        return false;
      }
    if (n == 3 && mesh_->degree(apex) == 3) {
      in_the_way = {apex};
      return false;
    }
    return true;
  }

  bool fan_keeps_delta(std::size_t pivot, double delta, Elements& in_the_way) const {
    const std::size_t n = star_.valence();
    for (std::size_t k = 1; k + 1 < n; ++k) {
      const std::size_t i = (pivot + k) % n, j = (pivot + k + 1) % n;
      if (!keeps_delta<Mesh>(star_.link_points[pivot], star_.link_points[i], star_.link_points[j], delta)) {
        in_the_way = {star_.link[pivot], star_.link[i], star_.link[j]};
        return false;
      }
    }
    return true;
  }
};

} // namespace haptic_sculpt::internal
