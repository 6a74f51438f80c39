// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Edit_result.h>
#include <haptic_sculpt/sculpting/culling/Distinct_numbers.h>
#include <haptic_sculpt/sculpting/edits/Edit_proof.h>
#include <haptic_sculpt/sculpting/edits/Mesh_watch.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

namespace haptic_sculpt::internal {

/// Decides whether the edge AB between the faces ABC and BAD can be flipped to CD: the new faces meet nothing
/// improperly, and nothing is in the tetrahedron ABCD between them and the old. Exact; the argument is in
/// doc/use/edits.md.
template <class Mesh, class Broad_phase>
class Flip_proof {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;
  using Halfedge_index = typename Mesh::Halfedge_index;
  using Refused = std::optional<Refusal<Mesh>>;

  Flip_proof(const Mesh& mesh, Broad_phase& broad_phase, const Face_corners<Mesh>& corners, Filter_counters& counters)
      : mesh_(&mesh), broad_phase_(&broad_phase), corners_of_(&corners), counters_(&counters), proof_(counters) {}

  /// A, B, C, D of the edge last asked about.
  const std::array<Vertex_index, 4>& corners() const { return vertices_; }

  /// \param h from A to B
  Refused refuse(Halfedge_index h, double delta) {
    const Halfedge_index opposite = mesh_->opposite(h);
    old_faces_ = {mesh_->face(h), mesh_->face(opposite)};
    Mesh_watch<Mesh>::check_faces(*corners_of_, old_faces_);
    vertices_ = {mesh_->source(h), mesh_->target(h), mesh_->target(mesh_->next(h)),
                 mesh_->target(mesh_->next(opposite))};
    const auto& [a, b, c, d] = vertices_;
    if (mesh_->halfedge(c, d).is_valid())
      return Refusal<Mesh>{Refusal_reason::doubled_edge, {c, d}};
    for (int i = 0; i < 4; ++i)
      points_[i] = vertex_coordinates(*mesh_, vertices_[i]);
    for (int i = 0; i < 2; ++i) {
      new_faces_[i] = {corner(2), corner(3), corner(i)};
      if (!keeps_delta<Mesh>(points_[2], points_[3], points_[i], delta))
        return Refusal<Mesh>{Refusal_reason::delta, {c, d, vertices_[i]}};
    }
    volume_ = orientation_3(points_[0], points_[1], points_[2], points_[3], *counters_);
    if (volume_ == 0) {
      // In a plane the new faces cover what the old ones covered, or they are folded.
      if (proof_.meet_improperly(new_faces_[0], new_faces_[1]))
        return Refusal<Mesh>{Refusal_reason::blocked, {a, b}};
      return std::nullopt;
    }
    return refuse_what_is_near();
  }

  void reserve(std::size_t usual_candidates) {
    candidates_.reserve(usual_candidates);
    sides_.reserve(3 * usual_candidates);
    numbers_.prepare(3 * usual_candidates);
  }

private:
  /// Bit k of a point that is not a corner: whether the plane of the tetrahedron's face opposite to corner k parts the
  /// two strictly. Of a corner: whether it lies in that plane. So three points with a common bit span a triangle that
  /// has no point of the tetrahedron but what the corners among them span.
  using Sides = unsigned;

  const Mesh* mesh_;
  Broad_phase* broad_phase_;
  const Face_corners<Mesh>* corners_of_;
  Filter_counters* counters_;
  Edit_proof<Mesh, Filter_counters> proof_;
  std::array<Face_index, 2> old_faces_;
  std::array<Vertex_index, 4> vertices_;
  std::array<Coordinates, 4> points_;
  std::array<Corners<Mesh>, 2> new_faces_;
  int volume_ = 0; ///< its sign
  std::vector<Face_index> candidates_;
  Distinct_numbers numbers_; ///< of the candidates' vertices
  std::vector<Sides> sides_; ///< of these

  Corner<Mesh> corner(int i) const { return {vertices_[i], points_[i]}; }

  Sides sides(const Coordinates& p) const {
    const auto& [a, b, c, d] = points_;
    return Sides(orientation_3(p, b, c, d, *counters_) * volume_ < 0) |
           Sides(orientation_3(a, p, c, d, *counters_) * volume_ < 0) << 1 |
           Sides(orientation_3(a, b, p, d, *counters_) * volume_ < 0) << 2 |
           Sides(orientation_3(a, b, c, p, *counters_) * volume_ < 0) << 3;
  }

  /// \pre the tetrahedron is not flat
  Refused refuse_what_is_near() {
    Box_3 box;
    for (const Coordinates& p : points_)
      box.include(p);
    candidates_.clear();
    broad_phase_->query(box, candidates_);
    std::sort(candidates_.begin(), candidates_.end()); // what is reported does not depend on the broad phase
    numbers_.prepare(4 + 3 * candidates_.size());
    sides_.clear();
    for (unsigned i = 0; i < 4; ++i) {
      numbers_.insert(static_cast<std::uint64_t>(vertices_[i]));
      sides_.push_back(15u ^ 1u << i);
    }
    for (const Face_index f : candidates_) {
      if (f == old_faces_[0] || f == old_faces_[1])
        continue;
      const auto& vertices = (*corners_of_)(f);
      Sides common = 15;
      for (const Vertex_index v : vertices) {
        const auto [place, is_new] = numbers_.insert(static_cast<std::uint64_t>(v));
        if (is_new) {
          sides_.push_back(sides(vertex_coordinates(*mesh_, v)));
          if (sides_.back() == 0)
            return Refusal<Mesh>{Refusal_reason::blocked, {v}}; // inside
        }
        common &= sides_[place];
      }
      if (common == 0 && meets_new(vertices))
        return Refusal<Mesh>{Refusal_reason::blocked, {vertices[0], vertices[1], vertices[2]}};
    }
    return std::nullopt;
  }

  bool meets_new(const std::array<Vertex_index, 3>& vertices) const {
    Corners<Mesh> face;
    for (int i = 0; i < 3; ++i)
      face[i] = {vertices[i], vertex_coordinates(*mesh_, vertices[i])};
    return proof_.meet_improperly(new_faces_[0], face) || proof_.meet_improperly(new_faces_[1], face);
  }
};

} // namespace haptic_sculpt::internal
