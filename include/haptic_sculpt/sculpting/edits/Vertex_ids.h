// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Mesh_changed.h>
#include <haptic_sculpt/surface/containers/make_room.h>

#include <string>
#include <vector>

namespace haptic_sculpt::internal {

/// Numbers of vertices that last: a new vertex takes the next number never used, and a removed one's number stays dead
/// until undo revives it. Surface_mesh's own indices are recycled and do neither.
///
/// At the beginning the number of a vertex is its index.
template <class Mesh>
class Vertex_ids {
public:
  using Vertex_index = typename Mesh::Vertex_index;

  explicit Vertex_ids(const Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.num_vertices(); ++i) {
      const Vertex_index v(static_cast<typename Vertex_index::size_type>(i));
      vertices_.push_back(mesh.is_removed(v) ? Vertex_index() : v);
      ids_.push_back(i);
    }
  }

  /// One more than the largest number ever given.
  std::size_t size() const { return vertices_.size(); }

  /// The vertex of that number, or the null index where it is dead or was never given.
  Vertex_index vertex(std::size_t id) const { return id < vertices_.size() ? vertices_[id] : Vertex_index(); }

  /// \pre v is in the mesh
  std::size_t id(Vertex_index v) const { return ids_[static_cast<std::size_t>(v)]; }
  /// \throw Mesh_changed where others have added v
  std::size_t checked_id(Vertex_index v) const {
    if (static_cast<std::size_t>(v) >= ids_.size())
      throw Mesh_changed("vertex " + std::to_string(static_cast<std::size_t>(v)) + " was added");
    return id(v);
  }

  /// Gives v a number: the next never used, which is size(), or a dead one. \pre id <= size(), and no vertex has it
  void give(std::size_t id, Vertex_index v) {
    const auto index = static_cast<std::size_t>(v);
    if (id == vertices_.size())
      vertices_.push_back(v);
    else
      vertices_[id] = v;
    if (index >= ids_.size())
      ids_.resize(index + 1);
    ids_[index] = id;
  }

  void take(std::size_t id) { vertices_[id] = Vertex_index(); }

  /// Room to give this number: where it is the next never used, it is one more.
  void make_room_for(std::size_t id) { make_room(vertices_, id + 1); }
  /// Room for this many numbers more.
  void reserve(std::size_t numbers) { vertices_.reserve(vertices_.size() + numbers); }
  /// Room for the numbers of this many slots of vertices in the mesh, in all.
  void reserve_slots(std::size_t slots) { ids_.reserve(slots); }

  /// Bytes held, capacity included.
  std::size_t memory() const {
    return vertices_.capacity() * sizeof(Vertex_index) + ids_.capacity() * sizeof(std::size_t);
  }

private:
  std::vector<Vertex_index> vertices_;
  std::vector<std::size_t> ids_;
};

} // namespace haptic_sculpt::internal
