// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_BRUTE_FORCE_BROAD_PHASE_H
#define HAPTIC_SCULPT_SURFACE_BRUTE_FORCE_BROAD_PHASE_H

#include <haptic_sculpt/surface/broad_phase/Swept_star_3.h>
#include <haptic_sculpt/surface/broad_phase/face_box.h>

namespace haptic_sculpt {

/// The broad phase that keeps nothing and asks every face: the oracle of the others.
///
/// A model of the concept *BroadPhase* (doc/broad_phase.md):
/// - constructible from `const Mesh&`, which must outlive it;
/// - `query(star, faces)` appends to `faces` every face of the mesh whose closed box meets `star.box()`, or at least every
///   face that meets the tetrahedra that the star sweeps; in any order, none twice, more faces are allowed;
/// - `query(box, faces)` appends at least every face whose closed box meets `box`;
/// - `faces_moved(range)`, `faces_inserted(range)`, `faces_removed(range)`: the points of these faces have changed, they
///   have come (also under an index used before), they have gone (called while the mesh still holds them or after; the
///   mesh is not read for them). Ranges of `Mesh::Face_index`.
///
/// Cost: a query reads every face; updates are free.
template <class Mesh>
class Brute_force_broad_phase {
public:
  using Face_index = typename Mesh::Face_index; ///< what queries append

  /// \param mesh has to outlive this; nothing is read yet
  explicit Brute_force_broad_phase(const Mesh& mesh) : mesh_(&mesh) {}

  /// Appends every face whose closed box meets that of the star.
  void query(const Swept_star_3& star, std::vector<Face_index>& faces) const { query(star.box(), faces); }

  /// Appends every face whose closed box meets the closed box.
  void query(const Box_3& box, std::vector<Face_index>& faces) const {
    for (const Face_index f : mesh_->faces())
      if (do_meet(face_box(*mesh_, f), box))
        faces.push_back(f);
  }

  template <class Faces>
  void faces_moved(const Faces&) {} ///< Does nothing: each query reads the mesh anew.
  template <class Faces>
  void faces_inserted(const Faces&) {} ///< Does nothing: each query reads the mesh anew.
  template <class Faces>
  void faces_removed(const Faces&) {} ///< Does nothing: each query reads the mesh anew.

private:
  const Mesh* mesh_;
};

} // namespace haptic_sculpt

#endif
