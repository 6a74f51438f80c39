// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/axis_moves/Axis_move.h>
#include <haptic_sculpt/sculpting/axis_moves/Faces_on_the_way.h>
#include <haptic_sculpt/sculpting/edits/Mesh_watch.h>

namespace haptic_sculpt::internal {

/// The axis move that is used next, with what it may meet: all of the mesh, which is kept until connectivity changes,
/// or what is on the way of a few vertices.
template <class Mesh>
class Axis_move_at_hand {
public:
  Axis_move_at_hand(const Mesh& mesh, Filter_counters& counters)
      : mesh_(&mesh), whole_move_(mesh, counters), near_move_(mesh, counters) {}

  /// Has it look at what these vertices may meet, each in the box of its place and its target, along any axis.
  template <class Broad_phase>
  void look_around(Broad_phase& broad_phase, const Vertex_targets<Mesh>& targets) {
    // An eighth of all vertices, removed ones too, over which the other way runs: then the search costs more than it
    // spares.
    constexpr std::size_t many = 8;
    are_many_ = many * targets.size() >= mesh_->num_vertices();
    if (!are_many_)
      return near_move_.take(on_the_way_.find(*mesh_, broad_phase, targets), false);
    if (whole_move_.has_taken_all())
      return;
    std::vector<typename Mesh::Face_index> faces(mesh_->faces().begin(), mesh_->faces().end());
    broad_phase.put_in_order(faces);
    whole_move_.take(faces, true);
  }
  /// Connectivity is about to change.
  void forget() { whole_move_.forget(); }

  /// The one that has looked around last.
  Axis_move<Mesh>& move() { return are_many_ ? whole_move_ : near_move_; }

  /// The ways as far as they are free, without those that lead nowhere.
  Axis_ways<Mesh> made_ways(int axis, const Axis_ways<Mesh>& ways) {
    Axis_ways<Mesh> made;
    for (const auto& [v, target] : ways)
      if (const double end = move().end(v); end != vertex_coordinates(*mesh_, v)[axis])
        made.emplace_back(v, end);
    return made;
  }

  /// \throw Mesh_changed where what it looks at was moved by others
  void check_unmoved(const Mesh_watch<Mesh>& watch) {
    if (move().has_taken_all())
      for (const auto v : mesh_->vertices())
        watch.check(v);
    else
      for (const Axis_item& item : move().items())
        for (const std::uint32_t v : item.corners)
          watch.check(typename Mesh::Vertex_index(v));
  }

  /// Bytes held, capacity included.
  std::size_t memory() const { return whole_move_.memory() + near_move_.memory() + on_the_way_.memory(); }

private:
  const Mesh* mesh_;
  Axis_move<Mesh> whole_move_, near_move_; ///< that look at all faces; at some
  bool are_many_ = false;                  ///< which of them looked around last
  Faces_on_the_way<Mesh> on_the_way_;
};

} // namespace haptic_sculpt::internal
