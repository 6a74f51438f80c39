// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/many_vertices/Rated_collapse.h>
#include <haptic_sculpt/sculpting/many_vertices/Remeshing_state.h>
#include <haptic_sculpt/sculpting/many_vertices/star_shape.h>

namespace haptic_sculpt::internal {

/// Collapses the short edges of a remeshing, the shortest first.
template <class State>
class Edge_collapser {
public:
  using Mesh = typename State::Mesh;
  using Vertex_index = typename Mesh::Vertex_index;
  using Edge_index = typename Mesh::Edge_index;
  using Halfedge_index = typename Mesh::Halfedge_index;
  using Face_index = typename Mesh::Face_index;

  explicit Edge_collapser(State& state) : state_(state), mesh_(state.mesh) {}

  void run() {
    Edge_queue<Mesh> queue(mesh_, state_.points, false);
    const auto offer = [&](Edge_index e) {
      if (const double l = state_.length(e); l < state_.low && state_.marks.is_inside(e))
        queue.push(e, l);
    };
    for (const Edge_index e : mesh_.edges())
      offer(e);
    for (auto entry = queue.pop(); entry.edge.is_valid(); entry = queue.pop()) {
      if (!state_.goes_on())
        return;
      const Halfedge_index h = mesh_.halfedge(entry.edge);
      std::array<Collapse, 2> ways = {rated_collapse(h), rated_collapse(mesh_.opposite(h))};
      if (ways[1].is_better_than(ways[0]))
        std::swap(ways[0], ways[1]);
      for (const Collapse& way : ways)
        if (way.is_wanted())
          if (const Vertex_index kept = collapse(way.halfedge); kept.is_valid()) {
            for (const Halfedge_index g : mesh_.halfedges_around_target(mesh_.halfedge(kept)))
              offer(mesh_.edge(g));
            break;
          }
    }
  }

private:
  using Collapse = Rated_collapse<Halfedge_index>;
  using Constraint = typename State::Marks::Constraint;
  using Patch = typename State::Marks::Patch;

  State& state_;
  const Mesh& mesh_;
  std::vector<Patch> patches_; ///< of the faces of the star at hand
  decltype(Star<Mesh>::faces) old_faces_; ///< these, of a collapse

  /// Whether the source may go into the target, as far as constraints are concerned: along a constrained edge, or off
  /// none.
  bool may_collapse(Halfedge_index h) const {
    const Vertex_index v = mesh_.source(h);
    if (state_.marks.is_fixed(v))
      return false;
    const int degree = state_.marks.constrained_degree(v);
    if (!state_.marks.is_constrained(mesh_.edge(h)))
      return degree == 0;
    return degree == 2 && state_.named.collapse_constraints && !state_.named.protect_constraints;
  }

  /// The measure of the least angle that stays, or -1 where the collapse is not wanted: constraints, a normal that
  /// turns over, an edge longer than what is split, a sliver.
  double shape_after_collapse(Halfedge_index h) {
    if (!may_collapse(h))
      return -1;
    state_.collect(mesh_.source(h));
    const Coordinates target = state_.place(mesh_.target(h));
    for (const Coordinates& p : state_.star.link_points)
      if (quick_squared_distance(p, target) > state_.high)
        return -1;
    return shape_after_move(state_.star, state_.place(state_.star.centre), target, position_in_link(mesh_.target(h)));
  }

  Collapse rated_collapse(Halfedge_index h) {
    const double shape = shape_after_collapse(h);
    return {h, shape,
            shape < 0 ? 0
                      : volume_of_collapse(state_.star, state_.place(state_.star.centre),
                                           position_in_link(mesh_.target(h)), state_.named.target_edge_length)};
  }

  std::size_t position_in_link(Vertex_index v) const {
    const auto& link = state_.star.link;
    return static_cast<std::size_t>(std::find(link.begin(), link.end(), v) - link.begin());
  }

  /// \return the target, or the null index
  Vertex_index collapse(Halfedge_index h) {
    const Vertex_index target = mesh_.target(h);
    state_.collect(mesh_.source(h));
    const Star<Mesh>& star = state_.star;
    // The other end of the line that the source is on, if it is on one.
    Vertex_index line_end;
    Constraint line;
    for (std::size_t i = 0; i < star.valence(); ++i)
      if (const Edge_index e = mesh_.edge(star.spoke(mesh_, i));
          star.link[i] != target && state_.marks.is_constrained(e)) {
        line_end = star.link[i];
        line = state_.marks.constraint(e);
      }
    if (line_end.is_valid())
      if (const Halfedge_index g = mesh_.halfedge(line_end, target);
          g.is_valid() && state_.marks.is_constrained(mesh_.edge(g)))
        return {}; // two lines would become one
    const std::size_t pivot = position_in_link(target);
    state_.samples.take(star.faces);
    if (!state_.keeps_near(state_.place(target), pivot))
      return {};
    patches_.clear();
    for (const Face_index f : star.faces)
      patches_.push_back(state_.marks.patch(f));
    old_faces_ = star.faces;
    state_.marks.make_room(star.valence());
    if (!State::counted(static_cast<bool>(state_.sculptor.collapse(h)), state_.report.collapses))
      return {};
    hand_on(target, pivot, line_end, line);
    return target;
  }

  /// What the faces of the star and the line had, to what has taken their places.
  void hand_on(Vertex_index target, std::size_t pivot, Vertex_index line_end, const Constraint& line) {
    const Star<Mesh>& star = state_.star;
    const std::size_t n = star.valence();
    // Around the target, from the one neighbour in the link to the other.
    std::size_t k = star.next(pivot);
    Halfedge_index g = mesh_.halfedge(star.link[k], target);
    for (std::size_t steps = 1;; ++steps) {
      const bool was_there = steps == 1 || steps == n - 1;
      if (star.link[k] == line_end)
        state_.marks.constrain(mesh_.edge(g), line);
      else if (!was_there)
        state_.marks.constrain(mesh_.edge(g), Constraint());
      if (steps == n - 1)
        break;
      state_.marks.face_created(mesh_.face(g), patches_[k]);
      state_.star.faces[k] = mesh_.face(g);
      g = mesh_.opposite(mesh_.next(g));
      k = star.next(k);
    }
    state_.samples.put(mesh_, old_faces_, [&](std::size_t i) { return star.faces[i]; });
  }
};

} // namespace haptic_sculpt::internal
