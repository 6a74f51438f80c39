// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_SCENE_BOUND_H
#define HAPTIC_SCULPT_SCULPTING_SCENE_BOUND_H

#include <haptic_sculpt/sculpting/contact/check_parameters.h>

namespace haptic_sculpt {
namespace internal {

/// A bound of the coordinates of all vertices of a mesh under way: it grows with every move, and is taken anew where
/// that matters.
template <class Mesh>
class Scene_bound {
public:
  explicit Scene_bound(const Mesh& mesh) : mesh_(&mesh) { include(Scene_extent(mesh).largest); }

  double largest_coordinate() const { return largest_; }

  /// A vertex has come to p.
  void include(const Coordinates& p) { include(largest_magnitude(p)); }
  /// Vertices may be again where any has been.
  void include_the_past() { largest_ = largest_ever_; }

  /// \throw Invalid_parameter where the scene has outgrown the clearance set.
  void check_clearance_serves(const Sculptor_parameters& parameters) {
    if (!parameters.clearance_length || *parameters.clearance_length >= unit_in_the_last_place(largest_))
      return;
    largest_ = Scene_extent(*mesh_).largest; // what was far may be back
    if (!(*parameters.clearance_length >= unit_in_the_last_place(largest_)))
      check_clearance(*mesh_, parameters);
  }

private:
  const Mesh* mesh_;
  double largest_ = 0;      ///< magnitude of a coordinate
  double largest_ever_ = 0; ///< the same, with those that vertices have had

  void include(double coordinate) {
    largest_ = std::max(largest_, coordinate);
    largest_ever_ = std::max(largest_ever_, coordinate);
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
