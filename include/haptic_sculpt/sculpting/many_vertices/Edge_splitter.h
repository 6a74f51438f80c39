// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/many_vertices/Remeshing_state.h>

namespace haptic_sculpt::internal {

/// Splits the long edges of a remeshing at their midpoints, the longest first, and none that has a longer one beside it
/// in a face.
///
/// So each face is halved at its longest edge. None of the four edges that take its place is longer than sqrt(3)/2 of
/// it: splitting ends. No angle gets smaller than half of the smallest (Rosenberg and Stenger, Mathematics of
/// Computation 29 (1975) 390-395). Else vertices would come ever nearer to a long edge that has to stay.
template <class State>
class Edge_splitter {
public:
  using Mesh = typename State::Mesh;
  using Vertex_index = typename Mesh::Vertex_index;
  using Edge_index = typename Mesh::Edge_index;
  using Halfedge_index = typename Mesh::Halfedge_index;
  using Face_index = typename Mesh::Face_index;

  explicit Edge_splitter(State& state) : state_(state), mesh_(state.mesh) {}

  void run() {
    Edge_queue<Mesh> queue(mesh_, state_.points, true);
    const auto offer = [&](Edge_index e) {
      if (const double l = state_.length(e); l > state_.high && may_split(e))
        queue.push(e, l);
    };
    for (const Edge_index e : mesh_.edges())
      offer(e);
    for (Entry entry = queue.pop(); entry.edge.is_valid(); entry = queue.pop()) {
      if (is_beside_longer(entry))
        continue;
      if (!state_.goes_on())
        return;
      if (const Vertex_index v = split(entry.edge); v.is_valid())
        for (const Halfedge_index h : mesh_.halfedges_around_target(mesh_.halfedge(v)))
          offer(mesh_.edge(h));
    }
  }

private:
  using Entry = typename Edge_queue<Mesh>::Entry;

  State& state_;
  const Mesh& mesh_;

  bool may_split(Edge_index e) const {
    return state_.marks.is_inside(e) && !(state_.named.protect_constraints && state_.marks.is_constrained(e));
  }

  /// Whether one of its faces has a longer edge. It stays: if it could be split, its turn came before.
  bool is_beside_longer(const Entry& entry) const {
    for (const Halfedge_index h : {mesh_.halfedge(entry.edge), mesh_.opposite(mesh_.halfedge(entry.edge))})
      for (const Halfedge_index g : {mesh_.next(h), mesh_.prev(h)})
        if (state_.length(mesh_.edge(g)) > entry.length)
          return true;
    return false;
  }

  /// \return the new vertex, or the null index
  Vertex_index split(Edge_index e) {
    state_.marks.make_room(4); // where no garbage is recycled
    const auto marks = state_.marks.split_of(e);
    const Halfedge_index h = mesh_.halfedge(e);
    const std::array<Face_index, 2> old_faces = {mesh_.face(h), mesh_.face(mesh_.opposite(h))};
    state_.samples.take(old_faces);
    Vertex_index v;
    if (mesh_.number_of_faces() + 2 <= state_.parameters.most_number_of_faces)
      if (const auto edit = state_.sculptor.insert_on_edge(
              e, CGAL::midpoint(mesh_.point(marks.ends[0]), mesh_.point(marks.ends[1]))))
        v = *edit.vertex;
    if (!State::counted(v.is_valid(), state_.report.splits))
      return v;
    state_.marks.split(v, marks);
    state_.project.created(v, marks.ends[0]);
    hand_on_samples(v, old_faces);
    return v;
  }

  /// To the nearest of the four faces of v. The surface is the same, up to the rounding of the midpoint.
  void hand_on_samples(Vertex_index v, const std::array<Face_index, 2>& old_faces) {
    state_.collect(v);
    const Star<Mesh>& star = state_.star;
    const Coordinates p = state_.place(v);
    state_.samples.fit(
        star.valence(),
        [&](const Coordinates& q, std::size_t i) {
          return squared_distance_to_triangle(q, p, star.link_points[star.next(i)], star.link_points[i]);
        },
        [](const Coordinates&, std::size_t) { return std::numeric_limits<double>::infinity(); });
    state_.samples.put(mesh_, old_faces, [&](std::size_t i) { return star.faces[i]; });
  }
};

} // namespace haptic_sculpt::internal
