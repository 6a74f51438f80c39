// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/geometry/stop.h>
#include <haptic_sculpt/sculpting/many_vertices/Edge_collapser.h>
#include <haptic_sculpt/sculpting/many_vertices/Edge_splitter.h>
#include <haptic_sculpt/sculpting/many_vertices/projections.h>

#include <cstdlib>

namespace haptic_sculpt::internal {

/// Splits, collapses and flips edges and relaxes vertices, each by a proven operation of the Sculptor, or not at all.
/// See doc/use/remeshing.md.
///
/// \tparam Project `project(v, point, patch)` gives where a vertex v of a patch that is to be at `point` goes;
/// `project.created(v, w)` tells of a new vertex near w
template <class Sculptor, class Marks, class Project>
class Remesher {
public:
  using Mesh = typename Sculptor::Mesh_type;
  using Vertex_index = typename Mesh::Vertex_index;
  using Edge_index = typename Mesh::Edge_index;
  using Halfedge_index = typename Mesh::Halfedge_index;
  using Face_index = typename Mesh::Face_index;

  Remesher(Sculptor& sculptor, const Scaled_points<Mesh>& points, Marks& marks, Project& project,
           const Remeshing_named_parameters& named, const Remeshing_parameters& parameters)
      : state_(sculptor, points, marks, project, named, parameters)
      , mesh_(sculptor.mesh())
      , marks_(marks)
      , named_(named)
      , drag_(Drag_parameters(sculptor.parameters().drag).once()) {}

  Remeshing_report run() {
    using Phase = Remeshing_progress::Phase;
    while (state_.report.iterations < named_.iterations) {
      if (state_.report.iterations != 0 && !state_.is_wanted()) // also where nothing is left to do
        break;
      if (named_.do_split && !in(Phase::split, [this] { Edge_splitter<State>(state_).run(); }))
        break;
      if (state_.report.iterations == 0) // so far no point is off the input
        state_.samples.begin(mesh_, state_.points, marks_);
      if (named_.do_collapse && !in(Phase::collapse, [this] { Edge_collapser<State>(state_).run(); }))
        break;
      if (named_.do_flip && !in(Phase::flip, [this] { flip_for_valence(); }))
        break;
      if (!in(Phase::relax, [this] { relax(); }))
        break;
      ++state_.report.iterations;
    }
    return state_.report;
  }

private:
  using State = Remeshing_state<Sculptor, Marks, Project>;

  static constexpr int usual_valence = 6;
  /// Of the way a vertex tries so much, one after the other.
  static constexpr double shares[] = {1, 0.5, 0.25, 0.125};

  State state_;
  const Mesh& mesh_;
  Marks& marks_;
  const Remeshing_named_parameters& named_;
  const Drag_parameters drag_;
  std::vector<int> valence_;

  template <class Work>
  bool in(Remeshing_progress::Phase phase, const Work& work) {
    state_.phase = phase;
    work();
    return !state_.report.cancelled;
  }

  void flip_for_valence() {
    valence_.assign(mesh_.num_vertices(), 0);
    for (const Edge_index e : mesh_.edges()) {
      ++valence(mesh_.vertex(e, 0));
      ++valence(mesh_.vertex(e, 1));
    }
    for (const Edge_index e : mesh_.edges()) {
      if (marks_.is_constrained(e) || !marks_.is_inside(e) || !is_flip_wanted(e))
        continue;
      if (!state_.goes_on())
        return;
      const auto [a, b, c, d] = corners(e);
      if (!State::counted(flip(e), state_.report.flips))
        continue;
      --valence(a), --valence(b), ++valence(c), ++valence(d);
    }
  }

  int& valence(Vertex_index v) { return valence_[static_cast<std::size_t>(v)]; }

  /// The ends, then the opposite corners.
  std::array<Vertex_index, 4> corners(Edge_index e) const {
    const Halfedge_index h = mesh_.halfedge(e), g = mesh_.opposite(h);
    return {mesh_.source(h), mesh_.target(h), mesh_.target(mesh_.next(h)), mesh_.target(mesh_.next(g))};
  }

  std::array<Face_index, 2> faces(Edge_index e) const {
    const Halfedge_index h = mesh_.halfedge(e);
    return {mesh_.face(h), mesh_.face(mesh_.opposite(h))};
  }

  /// Whether a flip brings valences nearer to six, or makes a sliver better, turns no normal over, and leaves the input
  /// near. \post if so the samples of its faces are in hand
  bool is_flip_wanted(Edge_index e) {
    const auto [va, vb, vc, vd] = corners(e);
    const auto excess = [&](Vertex_index v, int more) { return std::abs(valence(v) + more - usual_valence); };
    const int before = excess(va, 0) + excess(vb, 0) + excess(vc, 0) + excess(vd, 0),
              after = excess(va, -1) + excess(vb, -1) + excess(vc, 1) + excess(vd, 1);
    if (valence(va) <= 3 || valence(vb) <= 3)
      return false;
    const Coordinates a = state_.place(va), b = state_.place(vb), c = state_.place(vc), d = state_.place(vd);
    if (!shape_permits_flip(a, b, c, d, after < before))
      return false;
    state_.samples.take(faces(e));
    const bool is_near = state_.samples.fit(
        2,
        [&](const Coordinates& p, std::size_t i) {
          return squared_distance_to_triangle(p, c, d, i == 0 ? b : a);
        },
        [&](const Coordinates& p, std::size_t i) { return squared_distance_to_triangle(p, a, b, i == 0 ? c : d); });
    state_.report.too_far += !is_near;
    return is_near;
  }

  /// \pre is_flip_wanted()
  bool flip(Edge_index e) {
    const auto old_faces = faces(e);
    const auto patch = marks_.patch(old_faces[0]);
    marks_.make_room(2);
    const Vertex_index b = corners(e)[1];
    if (!state_.sculptor.flip(e))
      return false;
    auto new_faces = faces(e);
    if (corners(e)[2] != b)
      std::swap(new_faces[0], new_faces[1]);
    for (const Face_index f : new_faces)
      marks_.face_created(f, patch);
    state_.samples.put(mesh_, old_faces, [&](std::size_t i) { return new_faces[i]; });
    return true;
  }

  /// All targets from the places at the begin of a step; projected in the last step, so that relaxation and projection
  /// are one drag.
  void relax() {
    std::vector<std::pair<Vertex_index, Coordinates>> targets;
    const unsigned last = std::max(1u, named_.relaxation_steps);
    for (unsigned step = 1;; ++step) {
      targets.clear();
      for (const Vertex_index v : mesh_.vertices())
        if (const int degree = movable_degree(v); degree == 0) {
          const Coordinates p = step <= named_.relaxation_steps ? relaxed(v) : state_.place(v);
          targets.emplace_back(v, step >= named_.relaxation_steps ? state_.project(v, p, patch(v)) : p);
        } else if (degree == 2 && named_.relax_constraints && step <= named_.relaxation_steps) {
          targets.emplace_back(v, relaxed_on_line(v));
        }
      move_all(targets);
      if (step == last || !state_.is_wanted()) // asked where nothing moves, too: there may be 2^32 steps
        break;
    }
    if (state_.report.cancelled)
      return;
    if constexpr (Comes_after_relaxation<typename State::Project>::value) {
      targets.clear();
      auto& guarded = Sculptor_access::guarded(state_.sculptor);
      const auto projected = [this](Vertex_index v) { return state_.project.of_vertex(v); };
      for (const Vertex_index v : mesh_.vertices())
        if (movable_degree(v) == 0)
          targets.emplace_back(v, state_.points.in_unit(ask(guarded, projected, v)));
      move_all(targets);
    }
  }

  /// How many constrained edges v has, or -1 if it may not move at all.
  int movable_degree(Vertex_index v) const { return marks_.may_move(v) ? marks_.constrained_degree(v) : -1; }

  std::size_t patch(Vertex_index v) const {
    return static_cast<std::size_t>(marks_.patch(mesh_.face(mesh_.halfedge(v))));
  }

  Coordinates relaxed(Vertex_index v) {
    state_.collect(v);
    return relaxed_place(state_.star, state_.place(v));
  }

  /// As in CGAL, half of the way to the middle of the neighbours on the line; where the line bends by 60 degrees or
  /// more it has a corner, and v stays.
  Coordinates relaxed_on_line(Vertex_index v) {
    state_.collect(v);
    const Coordinates from = state_.place(v);
    Vector sum{}, ends[2]{};
    int n = 0;
    for (std::size_t i = 0; i < state_.star.valence(); ++i)
      if (is_crease(i)) {
        ends[n] = minus(state_.star.link_points[i], from);
        sum = plus(sum, ends[n++]);
      }
    constexpr double least_square_of_cosine = 0.25;
    const double product = quick_dot(ends[0], ends[1]);
    const bool is_line =
        product < 0 && product * product >
                         least_square_of_cosine * quick_dot(ends[0], ends[0]) * quick_dot(ends[1], ends[1]);
    return is_line ? quick_sum(from, 0.25, sum) : from;
  }

  /// Whether the edge from the centre of the star at hand to link[i] is constrained.
  bool is_crease(std::size_t i) const { return marks_.is_constrained(mesh_.edge(state_.star.spoke(mesh_, i))); }

  bool is_smooth(const Coordinates& p) const {
    return is_smooth_at(state_.star, p, [this](std::size_t i) { return is_crease(i); });
  }

  void move_all(const std::vector<std::pair<Vertex_index, Coordinates>>& targets) {
    for (const auto& [v, target] : targets) {
      state_.collect(v);
      if (target == state_.place(v) || !is_smooth(state_.place(v)))
        continue;
      if (!state_.goes_on())
        return;
      State::counted(move(v, target), state_.report.moves);
    }
  }

  /// As far of the way, of four shares, as the shape allows and is free. \pre the star is that of v
  bool move(Vertex_index v, const Coordinates& target) {
    const Coordinates from = state_.place(v);
    const Star<Mesh>& star = state_.star;
    state_.samples.take(star.faces);
    for (const double share : shares) {
      const Coordinates p = share == 1 ? target : point_of_path(from, target, share);
      if (is_in_range(state_.points.in_mesh(p)) && shape_after_move(star, from, p) >= 0 && is_smooth(p) &&
          state_.keeps_near(p) && state_.sculptor.move_if_free(v, state_.point(p), drag_)) {
        state_.samples.put(mesh_, star.faces, [&](std::size_t i) { return star.faces[i]; });
        state_.report.shortened += share != 1;
        return true;
      }
    }
    return false;
  }
};

} // namespace haptic_sculpt::internal
