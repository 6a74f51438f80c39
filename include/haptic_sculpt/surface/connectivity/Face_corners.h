// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

namespace haptic_sculpt::internal {

/// The corners of a face in the orientation of the mesh, from its halfedges.
template <class Mesh>
std::array<typename Mesh::Vertex_index, 3> corners_of_face(const Mesh& mesh, typename Mesh::Face_index f) {
  const auto h = mesh.halfedge(f);
  return {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
}

/// A copy of the corners of every face, 12 bytes a face.
///
/// Walking a face's halfedges in a large mesh waits for memory three times, one after the other; here once. Of
/// candidates' 58 faces in a million that is most of the cost of grabbing a vertex (doc/results/drags.md).
template <class Mesh>
class Face_corners {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;

  explicit Face_corners(const Mesh& mesh) : mesh_(&mesh) { update(mesh.faces()); }

  const std::array<Vertex_index, 3>& operator()(Face_index f) const { return corners_[f]; }

  /// These faces were made, or have other corners now.
  template <class Faces>
  void update(const Faces& faces) {
    if (mesh_->num_faces() > corners_.size())
      corners_.resize(mesh_->num_faces());
    for (const Face_index f : faces)
      corners_[f] = corners_of_face(*mesh_, f);
  }

  /// These faces die.
  template <class Faces>
  void forget(const Faces& faces) {
    for (const Face_index f : faces)
      corners_[f] = {};
  }

  /// Makes room for this many faces in all, so that update() allocates nothing.
  void reserve(std::size_t faces) { corners_.reserve(faces); }

  /// Whether the face is in the mesh as it was when it was made: with the same corners in the same orientation.
  bool is_as_it_was(Face_index f) const {
    if (static_cast<std::size_t>(f) >= corners_.size())
      return mesh_->is_removed(f);
    const auto& was = corners_[f];
    if (mesh_->is_removed(f) || !was[0].is_valid())
      return mesh_->is_removed(f) == !was[0].is_valid();
    const auto is = corners_of_face(*mesh_, f);
    // The face may begin with any of its halfedges.
    return is == was || (is[0] == was[1] && is[1] == was[2] && is[2] == was[0]) ||
           (is[0] == was[2] && is[1] == was[0] && is[2] == was[1]);
  }

  /// Bytes held, capacity included.
  std::size_t memory() const { return corners_.capacity() * sizeof(corners_[0]); }

private:
  const Mesh* mesh_;
  std::vector<std::array<Vertex_index, 3>> corners_;
};

} // namespace haptic_sculpt::internal
