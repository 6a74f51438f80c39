// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/connectivity/Face_corners.h>
#include <haptic_sculpt/surface/containers/Round_marks.h>
#include <haptic_sculpt/surface/broad_phase/Broad_phase_base.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

namespace haptic_sculpt::internal {

/// Vertices, and where they are to be.
template <class Mesh>
using Vertex_targets = std::vector<std::pair<typename Mesh::Vertex_index, std::array<double, 3>>>;

/// Finds the faces that move with some vertices, and all that these could meet as long as each vertex stays in the box
/// of its place and its target: what stands still is found by a broad phase, asked for some dozens of neighbours at a
/// time.
template <class Mesh>
class Faces_on_the_way {
public:
  using Face_index = typename Mesh::Face_index;
  using Vertex_index = typename Mesh::Vertex_index;

  /// \return near ones side by side; until the next call. Cost: n log n in what moves and is near
  template <class Broad_phase>
  const std::vector<Face_index>& find(const Mesh& mesh, Broad_phase& broad_phase, const Vertex_targets<Mesh>& targets) {
    faces_.clear();
    is_taken_.begin(mesh.num_faces());
    if (place_.size() < mesh.num_vertices())
      place_.resize(mesh.num_vertices());
    for (std::size_t k = 0; k < targets.size(); ++k) {
      place_[targets[k].first] = static_cast<std::uint32_t>(k);
      for (const Face_index f : mesh.faces_around_target(mesh.halfedge(targets[k].first)))
        take(f);
    }
    broad_phase.put_in_order(faces_);
    const std::size_t moving = faces_.size();
    for (std::size_t i = 0; i < moving;) {
      Box_3 box;
      for (const std::size_t end = std::min(i + faces_a_query, moving); i < end; ++i)
        for (const Vertex_index v : corners_of_face(mesh, faces_[i]))
          include_way(mesh, v, targets, box);
      found_.clear();
      broad_phase.query(box, found_);
      // Whatever the broad phase names beside these: the same faces are looked at with any.
      for (const Face_index f : found_)
        if (do_meet(face_box(mesh, f), box))
          take(f);
    }
    broad_phase.put_in_order(faces_);
    return faces_;
  }

  /// Bytes held, capacity included.
  std::size_t memory() const {
    return place_.capacity() * sizeof(std::uint32_t) + (faces_.capacity() + found_.capacity()) * sizeof(Face_index) +
           is_taken_.memory();
  }

private:
  static constexpr std::size_t faces_a_query = 64; ///< fewer cost more queries, more have larger boxes

  std::vector<std::uint32_t> place_; ///< of a vertex in the targets, where it is there; else anything
  std::vector<Face_index> faces_, found_; ///< by all queries, by one
  Round_marks is_taken_;                  ///< faces

  void include_way(const Mesh& mesh, Vertex_index v, const Vertex_targets<Mesh>& targets, Box_3& box) const {
    box.include(vertex_coordinates(mesh, v));
    if (const std::size_t k = place_[v]; k < targets.size() && targets[k].first == v)
      box.include(targets[k].second);
  }

  void take(Face_index f) {
    if (is_taken_.mark(static_cast<std::size_t>(f)))
      faces_.push_back(f);
  }
};

} // namespace haptic_sculpt::internal
