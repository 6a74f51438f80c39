// SPDX-License-Identifier: GPL-3.0-or-later
// For the reference only: what is asked of a template parameter. It is not compiled.

/// The concept of what finds the faces near something: the second template parameter of haptic_sculpt::Sculptor. A model is a class
/// template of the mesh that derives from haptic_sculpt::Broad_phase_base, which has all members but those here, and which it may
/// do better. Has models haptic_sculpt::Box_tree_broad_phase, haptic_sculpt::Six_list_broad_phase and
/// haptic_sculpt::Brute_force_broad_phase.
///
/// No result depends on the model. Answers name no face twice and no dead face, in any order. Coordinates are finite doubles of any
/// size. A query may change the model, so one belongs to one thread at a time. Where faces_inserted(), faces_removed(), or
/// faces_moved() within an edit throws, the Sculptor ends (doc/proofs/edits.md, "Memory that runs out"): a model that allocates
/// there has `reserve()` of its own.
template <class Mesh>
class BroadPhase : public haptic_sculpt::Broad_phase_base<Mesh, BroadPhase<Mesh>> {
public:
  /// Refers to the mesh, which outlives it. Faces that are removed and not collected yet are ignored; there may be none.
  explicit BroadPhase(const Mesh& mesh);

  /// Appends at least every face whose closed box meets the closed `box`.
  void query(const haptic_sculpt::Box_3& box, std::vector<typename Mesh::Face_index>& faces);

  /// Points of these known faces have changed, or their corners (a flip). `Faces` is a range of `Mesh::Face_index`.
  template <class Faces>
  void faces_moved(const Faces& faces); // many_faces_moved(), inherited, calls it after an axis move
  /// These faces have come, also under an index used before.
  template <class Faces>
  void faces_inserted(const Faces& faces);
  /// These have gone; the mesh is not read, it may hold them still or not.
  template <class Faces>
  void faces_removed(const Faces& faces);
};
