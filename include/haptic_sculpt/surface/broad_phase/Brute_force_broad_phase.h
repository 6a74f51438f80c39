// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/broad_phase/Broad_phase_base.h>

namespace haptic_sculpt {

/// The broad phase that keeps nothing and asks every face: the oracle of the others.
///
/// A model of BroadPhase. Cost: a query reads every face; updates are free.
template <class Mesh>
class Brute_force_broad_phase : public Broad_phase_base<Mesh, Brute_force_broad_phase<Mesh>> {
public:
  using Face_index = typename Mesh::Face_index; ///< what queries append

  /// \param mesh has to outlive this
  explicit Brute_force_broad_phase(const Mesh& mesh) : Broad_phase_base<Mesh, Brute_force_broad_phase>(mesh) {}

  /// Appends every face whose closed box meets the closed box.
  void query(const Box_3& box, std::vector<Face_index>& faces) const {
    for (const Face_index f : this->mesh().faces())
      if (do_meet(face_box(this->mesh(), f), box))
        faces.push_back(f);
  }

  template <class Faces>
  void faces_moved(const Faces&) {} ///< Does nothing: each query reads the mesh anew.
  template <class Faces>
  void faces_inserted(const Faces&) {} ///< Does nothing: each query reads the mesh anew.
  template <class Faces>
  void faces_removed(const Faces&) {} ///< Does nothing: each query reads the mesh anew.
};

} // namespace haptic_sculpt
