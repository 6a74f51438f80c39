// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_EDIT_VISITOR_H
#define HAPTIC_SCULPT_SCULPTING_EDIT_VISITOR_H

#include <cstddef>

namespace haptic_sculpt {

/// The concept EditVisitor, and its model that ignores everything: no call is then made, and nothing is looked up for
/// one.
///
/// A Sculptor tells its visitor of every element that a drag, placement, creation, removal, flip, undo or redo moves,
/// kills or creates. Derive from this class and hide the functions of interest; descriptors are those of the mesh.
///
/// - A drag that moved its vertex, or such a one undone or redone: `vertex_moved`, after the move, once
///   however many legs there were.
///   A shift of many vertices, too, made, undone or redone: `vertex_moved` of each, when all stand.
///   A stroke is undone and redone change by change, the drags of a vertex between two other edits as one.
/// - All other edits, undone and redone ones included, replace some faces by others. First, while the mesh is still as
/// before,
///   `face_dies`, `edge_dies`, `vertex_dies` of what the edit takes away; then, when the mesh is complete again,
///   `vertex_created`, `edge_created`, `face_created` of what it has made. Each element once.
/// - A face or edge is the triangle or segment of its vertices: one that is replaced has died, though one of the new
/// ones may have
///   got its descriptor, as Surface_mesh uses them again, within one edit too. What died has to be forgotten before the
///   new is noted.
/// - A visitor that has data of its own for faces or edges may also have `face_replaces(created, dead)` and
///   `edge_replaces(created, dead)`: before `vertex_created`, for each new element that comes from an old one, with the
///   descriptor that the old one had (doc/use/properties.md says which comes from which). Undo and redo tell it, too.
/// - Nothing is told of what was refused, or lacked memory, of a drag that did not move, of Sculptor::probe(), of
/// set_delta() and the
///   like; of an undo of several changes that ended so halfway, what was taken back and made again.
///
/// - An exception goes on to the caller of the edit, and the Sculptor works as before. Thrown in one of the `*_dies`,
/// the change is
///   not made, though some of what it would have killed has been told; thrown in another function, it stands, and the
///   rest of it is not told. An undo or redo of several changes ends there: the next goes on with what is left of the
///   step.
///
/// \pre The functions do not change the mesh and do not call the Sculptor's edits.
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

#endif
