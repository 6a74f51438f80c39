// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/contact/check_parameters.h>

namespace haptic_sculpt::internal {

/// A bound of the coordinates of all vertices of a mesh under way: it grows with every move, and is taken anew where
/// that matters. And whether clearances serve the scene that it bounds.
template <class Mesh>
class Scene_bound {
public:
  explicit Scene_bound(const Mesh& mesh) : mesh_(&mesh) { include(Scene_extent(mesh).largest); }

  double largest_coordinate() const { return std::max(largest_, expected_); }

  /// All vertices are where they are.
  void include_all() { include(Scene_extent(*mesh_).largest); }
  /// A vertex has come to p.
  void include(const Coordinates& p) { include(largest_magnitude(p)); }
  /// A vertex may come to p in an edit, and may be asked about before that is over.
  void expect(const Coordinates& p) { expected_ = largest_magnitude(p); }
  void expect_none() { expected_ = 0; }
  /// Vertices may be again where any has been.
  void include_the_past() { largest_ = largest_ever_; }

  /// \param usual of what is given none of its own. It was checked when it was set: whatever is asked for since, and
  /// however the scene changes, it is refused only where the scene outgrows it, so that a log that sets it is made
  /// again \throw Out_of_range; Invalid_parameter where the clearance does not serve the scene, or the scene has
  /// outgrown it.
  void check_clearance_serves(const std::optional<double>& clearance, const std::optional<double>& usual) {
    if (!clearance)
      return;
    if (clearance != usual && clearance != checked_) {
      check_length(clearance);
      check_clearance(*mesh_, clearance);
      checked_ = clearance;
    }
    if (has_outgrown(clearance))
      check_clearance(*mesh_, clearance);
  }
  /// Whether a clearance is less than can be kept in the scene as it is.
  bool has_outgrown(const std::optional<double>& clearance) {
    if (!clearance || *clearance >= unit_in_the_last_place(largest_))
      return false;
    largest_ = Scene_extent(*mesh_).largest; // what was far may be back
    return !(*clearance >= unit_in_the_last_place(largest_));
  }

private:
  const Mesh* mesh_;
  std::optional<double> checked_; ///< an unusual one that served the scene when it was first used
  double largest_ = 0;      ///< magnitude of a coordinate
  double largest_ever_ = 0; ///< the same, with those that vertices have had
  double expected_ = 0;     ///< the same, of a vertex that is not in the mesh yet

  void include(double coordinate) {
    largest_ = std::max(largest_, coordinate);
    largest_ever_ = std::max(largest_ever_, coordinate);
  }
};

} // namespace haptic_sculpt::internal
