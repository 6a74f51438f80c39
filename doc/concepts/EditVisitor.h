// SPDX-License-Identifier: GPL-3.0-or-later
// For the reference only: what is asked of a template parameter. It is not compiled.

/// The concept of what hears of changes of a mesh: the third template parameter of haptic_sculpt::Sculptor. A model
/// derives from haptic_sculpt::Default_edit_visitor, which ignores everything, and hides the functions of interest: of
/// the others no call is made, and nothing is looked up for one. Has models haptic_sculpt::Default_edit_visitor and
/// haptic_sculpt::Scene_visitor.
///
/// Descriptors are those of the mesh. The functions do not change the mesh, nor anything of the Sculptor:
/// haptic_sculpt::Reentrant_call is thrown where they try. They may ask it.
///
/// - *Moves.* `vertex_moved` is called once for each drag that moved its vertex, however many legs there were, and for
///   each vertex of a shift when all stand; made, undone and redone alike. A stroke is undone and redone change by
///   change, the drags of a vertex between two other edits as one.
/// - *All other edits*, undone and redone ones too, replace some faces by others. While the mesh is still as it was,
///   `face_dies`, `edge_dies` and `vertex_dies` are called for what the edit takes away. When the mesh is complete
///   again, `vertex_created`, `edge_created` and `face_created` are called for what it has made. Each element is named
///   once.
/// - *Descriptors are used again*, within one edit too. A face or edge is the triangle or segment of its vertices: one
///   that is replaced has died, and a new one may have its descriptor. Forget what died before you note what is new.
/// - *Nothing is said* of what was refused or lacked memory, of a drag that did not move, of
///   haptic_sculpt::Sculptor::probe(), and of settings.
/// - *An exception* goes on to the caller of the edit, and the Sculptor works as before. Thrown in one of the `*_dies`,
///   the change is not made, though some of what it would have killed has been named. Thrown in another function, the
///   change stands, and the rest of it is not told, but where `face_replaces` or `edge_replaces` threw. An undo or redo
///   of several changes is made whole or not at all. What was done of it is taken back. The functions above hear of
///   that until one throws again; `face_replaces` and `edge_replaces` hear of all of it.
class EditVisitor : public haptic_sculpt::Default_edit_visitor {
public:
  /// v is at its new place.
  template <class Vertex_index>
  void vertex_moved(Vertex_index v);

  /// v is still in the mesh. \param id haptic_sculpt::Sculptor::id()
  template <class Vertex_index>
  void vertex_dies(Vertex_index v, std::size_t id);
  /// e is still in the mesh.
  template <class Edge_index>
  void edge_dies(Edge_index e);
  /// f is still in the mesh.
  template <class Face_index>
  void face_dies(Face_index f);

  /// \param id a new number, or the old one of a vertex that undo or redo has revived, maybe with another descriptor
  template <class Vertex_index>
  void vertex_created(Vertex_index v, std::size_t id);
  /// The mesh is complete again.
  template <class Edge_index>
  void edge_created(Edge_index e);
  /// The mesh is complete again.
  template <class Face_index>
  void face_created(Face_index f);

  /// May be left out; for a visitor with data of its own for edges. Before `vertex_created`, for each new edge that comes from an old
  /// one (doc/use/properties.md says which). \param dead the descriptor that the old one had
  template <class Edge_index>
  void edge_replaces(Edge_index created, Edge_index dead);
  /// The same for faces. Of two old ones of a flip one is named, for both new ones.
  template <class Face_index>
  void face_replaces(Face_index created, Face_index dead);
};
