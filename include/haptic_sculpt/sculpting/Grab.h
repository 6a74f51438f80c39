// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_GRAB_H
#define HAPTIC_SCULPT_SCULPTING_GRAB_H

#include <haptic_sculpt/sculpting/Drag_result.h>

#include <vector>

namespace haptic_sculpt {

/// A vertex in the hand: made by `Sculptor::grab()`, dragged as often as wanted, let go by `release()` or destruction.
///
/// Refers to its Sculptor, which must outlive it. Stays usable across edits; while its vertex is removed, drags end as
/// Drag_end::stale and move nothing, until undo or redo revives it.
template <class Sculptor>
class Grab {
public:
  using Mesh = typename Sculptor::Mesh_type;
  using Point = typename Mesh::Point;
  using Vertex_index = typename Mesh::Vertex_index;

  Grab(Sculptor& sculptor, std::size_t name) : sculptor_(&sculptor), name_(name) {}

  /// The vertex; the null index once it has been removed, until undo revives it (maybe under another index).
  Vertex_index vertex() const { return sculptor_->vertex(name_); }

  /// Drags the vertex towards `target` in a straight line, until it is there or something would be touched.
  ///
  /// \post The mesh is embedded as before, exactly, and nothing was crossed on the way.
  /// \throw Out_of_range, Invalid_parameter, Mesh_changed; the mesh is then as it was.
  /// Cost: the candidates near the star times its valence; a look at the broad phase when the star leaves its region.
  /// Allocates nothing once it is warm: no list longer than any before, no more contacts than Drag_result::usual_contacts, at most
  /// Edit_history::room moves since the grab, and no delta rule so nearly broken that it takes rational numbers to decide.
  Drag_result<Mesh> drag_to(const Point& target) { return sculptor_->drag(vertex(), target); }

  /// The same, and says on which way: where the vertex was, and where it was after each of the `legs` of the result, each a straight
  /// motion that was proven free; `position` is the last point. Of a removed vertex none. \param path is written anew
  Drag_result<Mesh> drag_to(const Point& target, std::vector<Point>& path) { return sculptor_->drag(vertex(), target, &path); }

  /// Lets go. The next drag begins without contacts.
  void release() { sculptor_->release(); }

private:
  Sculptor* sculptor_;
  std::size_t name_; ///< a number that lasts: the mesh's own indices are recycled
};

} // namespace haptic_sculpt

#endif
