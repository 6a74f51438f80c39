// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/exchange/Changed_faces.h>
#include <haptic_sculpt/haptic_rendering/exchange/Scene_copy.h>
#include <haptic_sculpt/sculpting/Edit_visitor.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <new>

namespace haptic_sculpt {

/// An EditVisitor that remembers which faces have changed, for a viewer, and keeps a copy under way right.
template <class Mesh>
class Scene_visitor : public Default_edit_visitor {
public:
  using Vertex_index = typename Mesh::Vertex_index; ///< of the mesh
  using Face_index = typename Mesh::Face_index;     ///< of the mesh

  /// \param mesh refers to it; it must outlive this and its copies
  explicit Scene_visitor(const Mesh& mesh) : mesh_(&mesh) {}

  Changed_faces changed; ///< what a viewer does not know yet

  /// All faces are to be passed on, and there is room for this many more.
  void mark_all(std::size_t more) {
    changed.reserve(mesh_->num_faces() + more);
    mark_all();
  }
  /// The same within the room that there is.
  void mark_all() { changed.add_all(static_cast<std::uint32_t>(mesh_->num_faces())); }

  /// A face is to be passed on; where there is no memory to remember which, all are.
  void mark(Face_index f) {
    try {
      changed.add(static_cast<std::uint32_t>(f));
    } catch (const std::bad_alloc&) {
      mark_all();
    }
  }

  void tell_to(Scene_copy* copy) { copy_ = copy; } ///< that is under way; none: nullptr
  const Scene_copy* copy() const { return copy_; } ///< that hears of changes; none: nullptr

  /// \name What the Sculptor calls
  ///@{

  /// Its faces have changed.
  void vertex_moved(Vertex_index v) {
    for (const Face_index f : mesh_->faces_around_target(mesh_->halfedge(v)))
      mark(f);
    if (copy_ != nullptr)
      copy_->move_vertex(static_cast<std::uint32_t>(v), vertex_coordinates(*mesh_, v));
  }
  /// Goes into the copy.
  void vertex_created(Vertex_index v, std::size_t id) {
    if (copy_ != nullptr)
      copy_->set_vertex(static_cast<std::uint32_t>(v), id, vertex_coordinates(*mesh_, v));
  }
  /// Leaves the copy.
  void vertex_dies(Vertex_index v, std::size_t) {
    if (copy_ != nullptr)
      copy_->unset_vertex(static_cast<std::uint32_t>(v));
  }
  /// Has changed.
  void face_created(Face_index f) {
    changed_face(f, copy_ == nullptr ? Scene_copy::no_face : Scene_copy::corners_of(*mesh_, f));
  }
  /// Has changed, too.
  void face_dies(Face_index f) { changed_face(f, Scene_copy::no_face); }
  ///@}

private:
  const Mesh* mesh_;
  Scene_copy* copy_ = nullptr;

  void changed_face(Face_index f, const std::array<std::uint32_t, 3>& corners) {
    mark(f);
    if (copy_ != nullptr)
      copy_->set_face(static_cast<std::uint32_t>(f), corners);
  }
};

} // namespace haptic_sculpt
