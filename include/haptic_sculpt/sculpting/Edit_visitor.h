// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace haptic_sculpt {

/// The model of EditVisitor that ignores everything: no call is made, and nothing is looked up for one. Derive from it,
/// and hide the functions of interest; the concept says when each is called.
struct Default_edit_visitor {
  template <class Vertex_index>
  void vertex_moved(Vertex_index) {} ///< after the move, with the vertex at its new place
  /// With the number that lasts, `Sculptor::id()`.
  template <class Vertex_index>
  void vertex_dies(Vertex_index, std::size_t /*number*/) {}
  template <class Edge_index>
  void edge_dies(Edge_index) {} ///< while it is still in the mesh
  template <class Face_index>
  void face_dies(Face_index) {} ///< while it is still in the mesh
  /// With a new number, or the old one of a vertex that undo or redo has revived, maybe with another descriptor.
  template <class Vertex_index>
  void vertex_created(Vertex_index, std::size_t /*number*/) {}
  template <class Edge_index>
  void edge_created(Edge_index) {} ///< when the mesh is complete again
  template <class Face_index>
  void face_created(Face_index) {} ///< when the mesh is complete again
};

} // namespace haptic_sculpt
