// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_REMESHER_H
#define HAPTIC_SCULPT_SCULPTING_REMESHER_H

#include <haptic_sculpt/sculpting/Remeshing_report.h>
#include <haptic_sculpt/sculpting/many_vertices/Edge_queue.h>
#include <haptic_sculpt/sculpting/many_vertices/Rated_collapse.h>
#include <haptic_sculpt/sculpting/many_vertices/Remeshing_marks.h>
#include <haptic_sculpt/sculpting/many_vertices/Response_scope.h>
#include <haptic_sculpt/sculpting/many_vertices/projections.h>
#include <haptic_sculpt/sculpting/many_vertices/star_shape.h>
#include <haptic_sculpt/sculpting/motion/stop.h>

#include <cstdlib>
#include <unordered_set>

namespace haptic_sculpt {
namespace internal {

/// What is asked of a remeshing; the names are CGAL's.
struct Remeshing_options {
  double target_edge_length = 0;
  unsigned iterations = 1, relaxation_steps = 1;
  bool protect_constraints = false, collapse_constraints = true;
  bool do_split = true, do_collapse = true, do_flip = true;
};

/// Splits, collapses and flips edges and relaxes vertices, each by a proven operation of the Sculptor, or not at all.
/// See doc/many_vertices.md.
///
/// \tparam Project `project(v, point)` gives where a vertex v that is to be at `point` goes; `project.created(v, w)`
/// tells of a new vertex near w
template <class Sculptor, class Marks, class Project>
class Remesher {
public:
  using Mesh = typename Sculptor::Mesh_type;
  using Point = typename Mesh::Point;
  using Vertex_index = typename Mesh::Vertex_index;
  using Edge_index = typename Mesh::Edge_index;
  using Halfedge_index = typename Mesh::Halfedge_index;

  Remesher(Sculptor& sculptor, Marks& marks, Project& project, const Remeshing_options& options,
           const Remeshing_parameters& parameters)
      : sculptor_(sculptor)
      , mesh_(sculptor.mesh())
      , marks_(marks)
      , project_(project)
      , options_(options)
      , parameters_(parameters)
      , low_(square(options.target_edge_length * 4 / 5))
      , high_(square(options.target_edge_length * 4 / 3)) {}

  Remeshing_report run() {
    const Response_scope<Sculptor> scope(sculptor_, sculptor_.options().response_rule, true);
    using Phase = Remeshing_progress::Phase;
    while (report_.iterations < options_.iterations) {
      if (options_.do_split && !in(Phase::split, [this] { split_long_edges(); }))
        break;
      if (options_.do_collapse && !in(Phase::collapse, [this] { collapse_short_edges(); }))
        break;
      if (options_.do_flip && !in(Phase::flip, [this] { flip_for_valence(); }))
        break;
      if (!in(Phase::relax, [this] { relax(); }))
        break;
      ++report_.iterations;
    }
    return report_;
  }

private:
  static constexpr int usual_valence = 6;
  /// Of the way a vertex tries so much, one after the other.
  static constexpr double shares[] = {1, 0.5, 0.25, 0.125};

  Sculptor& sculptor_;
  const Mesh& mesh_;
  Marks& marks_;
  Project& project_;
  const Remeshing_options& options_;
  const Remeshing_parameters& parameters_;
  double low_, high_; ///< squares of the lengths at which edges are collapsed and split
  Remeshing_report report_;
  Remeshing_progress::Phase phase_ = Remeshing_progress::Phase::split;
  std::size_t operations_ = 0;
  Star<Mesh> star_;
  std::vector<int> valence_;
  std::unordered_set<Edge_index> unsplit_; ///< splits of this iteration that were refused

  using Entry = typename Edge_queue<Mesh>::Entry;

  using Collapse = Rated_collapse<Halfedge_index>;

  static double square(double x) { return x * x; }
  Coordinates place(Vertex_index v) const { return vertex_coordinates(mesh_, v); }
  double length(Edge_index e) const { return squared_length(mesh_, e); }

  template <class Work>
  bool in(Remeshing_progress::Phase phase, const Work& work) {
    phase_ = phase;
    work();
    return !report_.cancelled;
  }

  /// Before an operation: whether it may be made.
  bool goes_on() {
    if (!report_.cancelled && parameters_.progress_function &&
        operations_ % Remeshing_parameters::operations_between_calls == 0)
      report_.cancelled = !parameters_.progress_function(Remeshing_progress{report_.iterations, phase_, operations_});
    ++operations_;
    return !report_.cancelled;
  }

  static bool counted(bool done, Remeshing_report::Count& count) {
    ++(done ? count.done : count.refused);
    return done;
  }

  /// The longest first.
  void split_long_edges() {
    unsplit_.clear();
    Edge_queue<Mesh> queue(mesh_, true);
    const auto offer = [&](Edge_index e) {
      if (const double l = length(e); l > high_ && may_split(e))
        queue.push(e, l);
    };
    for (const Edge_index e : mesh_.edges())
      offer(e);
    for (Entry entry = queue.pop(); entry.edge.is_valid(); entry = queue.pop()) {
      if (is_beside_longer_that_stays(entry))
        continue;
      if (!goes_on())
        return;
      const Vertex_index a = mesh_.vertex(entry.edge, 0), b = mesh_.vertex(entry.edge, 1);
      const bool was_constrained = marks_.is_constrained(entry.edge);
      const auto edit = sculptor_.insert_on_edge(entry.edge, CGAL::midpoint(mesh_.point(a), mesh_.point(b)));
      if (!counted(static_cast<bool>(edit), report_.splits)) {
        unsplit_.insert(entry.edge);
        continue;
      }
      const Vertex_index v = *edit.vertex;
      marks_.split(v, a, b, was_constrained);
      project_.created(v, a);
      for (const Halfedge_index h : mesh_.halfedges_around_target(mesh_.halfedge(v)))
        offer(mesh_.edge(h));
    }
  }

  bool may_split(Edge_index e) const {
    return marks_.is_inside(e) && !(options_.protect_constraints && marks_.is_constrained(e)) && unsplit_.count(e) == 0;
  }

  /// Whether a longer edge of one of its faces may not be split: then splits beside it would go on for ever.
  bool is_beside_longer_that_stays(const Entry& entry) const {
    for (const Halfedge_index h : {mesh_.halfedge(entry.edge), mesh_.opposite(mesh_.halfedge(entry.edge))})
      for (const Halfedge_index g : {mesh_.next(h), mesh_.prev(h)})
        if (length(mesh_.edge(g)) > entry.length && !may_split(mesh_.edge(g)))
          return true;
    return false;
  }

  /// The shortest first.
  void collapse_short_edges() {
    Edge_queue<Mesh> queue(mesh_, false);
    const auto offer = [&](Edge_index e) {
      if (const double l = length(e); l < low_ && marks_.is_inside(e))
        queue.push(e, l);
    };
    for (const Edge_index e : mesh_.edges())
      offer(e);
    for (Entry entry = queue.pop(); entry.edge.is_valid(); entry = queue.pop()) {
      if (!goes_on())
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

  /// Whether the source may go into the target, as far as constraints are concerned: along a constrained edge, or off
  /// none.
  bool may_collapse(Halfedge_index h) const {
    const Vertex_index v = mesh_.source(h);
    if (marks_.is_fixed(v))
      return false;
    const int degree = marks_.constrained_degree(v);
    if (!marks_.is_constrained(mesh_.edge(h)))
      return degree == 0;
    return degree == 2 && options_.collapse_constraints && !options_.protect_constraints;
  }

  /// The measure of the least angle that stays, or -1 where the collapse is not wanted: constraints, a normal that
  /// turns over, an edge longer than what is split, a sliver.
  double shape_after_collapse(Halfedge_index h) {
    if (!may_collapse(h))
      return -1;
    star_.collect(mesh_, mesh_.source(h));
    const Coordinates target = place(mesh_.target(h));
    for (const Coordinates& p : star_.link_points)
      if (squared_length(p, target) > high_)
        return -1;
    return shape_after_move(star_, place(star_.centre), target, position_in_link(mesh_.target(h)));
  }

  Collapse rated_collapse(Halfedge_index h) {
    const double shape = shape_after_collapse(h);
    return {h, shape,
            shape < 0 ? 0
                      : volume_of_collapse(star_, place(star_.centre), position_in_link(mesh_.target(h)),
                                           options_.target_edge_length)};
  }

  std::size_t position_in_link(Vertex_index v) const {
    return static_cast<std::size_t>(std::find(star_.link.begin(), star_.link.end(), v) - star_.link.begin());
  }

  /// \return the target, or the null index
  Vertex_index collapse(Halfedge_index h) {
    const Vertex_index target = mesh_.target(h);
    star_.collect(mesh_, mesh_.source(h));
    // The other end of the line that the source is on, if it is on one.
    Vertex_index line_end;
    for (const Halfedge_index g : mesh_.halfedges_around_target(mesh_.halfedge(star_.centre)))
      if (marks_.is_constrained(mesh_.edge(g)) && mesh_.source(g) != target)
        line_end = mesh_.source(g);
    if (line_end.is_valid())
      if (const Halfedge_index g = mesh_.halfedge(line_end, target);
          g.is_valid() && marks_.is_constrained(mesh_.edge(g)))
        return {}; // two lines would become one
    const std::size_t pivot = position_in_link(target), n = star_.valence();
    if (!counted(static_cast<bool>(sculptor_.collapse(h)), report_.collapses))
      return {};
    // New are the edges to all of the link but the target's own neighbours in it, and the faces between them.
    for (const Halfedge_index g : mesh_.halfedges_around_target(mesh_.halfedge(target))) {
      const std::size_t k = position_in_link(mesh_.source(g));
      if (k == n)
        continue;
      const bool was_there = k == (pivot + 1) % n || k == (pivot + n - 1) % n;
      if (mesh_.source(g) == line_end)
        marks_.constrain(mesh_.edge(g), true);
      else if (!was_there)
        marks_.constrain(mesh_.edge(g), false);
      marks_.face_created(mesh_.face(g));
      marks_.face_created(mesh_.face(mesh_.opposite(g)));
    }
    return target;
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
      if (!goes_on())
        return;
      const auto [a, b, c, d] = corners(e);
      if (!counted(static_cast<bool>(sculptor_.flip(e)), report_.flips))
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

  /// Whether a flip brings valences nearer to six, or makes a sliver better, and turns no normal over.
  bool is_flip_wanted(Edge_index e) {
    const auto [va, vb, vc, vd] = corners(e);
    const auto excess = [&](Vertex_index v, int more) { return std::abs(valence(v) + more - usual_valence); };
    const int before = excess(va, 0) + excess(vb, 0) + excess(vc, 0) + excess(vd, 0),
              after = excess(va, -1) + excess(vb, -1) + excess(vc, 1) + excess(vd, 1);
    if (valence(va) <= 3 || valence(vb) <= 3)
      return false;
    return shape_permits_flip(place(va), place(vb), place(vc), place(vd), after < before);
  }

  /// All targets from the places at the begin of a step; projected in the last step, so that relaxation and projection
  /// are one drag.
  void relax() {
    std::vector<std::pair<Vertex_index, Coordinates>> targets;
    for (unsigned step = 1; step <= options_.relaxation_steps || step == 1; ++step) {
      targets.clear();
      for (const Vertex_index v : mesh_.vertices())
        if (marks_.is_free(v)) {
          const Coordinates p = step <= options_.relaxation_steps ? relaxed(v) : place(v);
          targets.emplace_back(v, step >= options_.relaxation_steps ? project_(v, p) : p);
        }
      move_all(targets);
    }
    if constexpr (Comes_after_relaxation<Project>::value) {
      targets.clear();
      for (const Vertex_index v : mesh_.vertices())
        if (marks_.is_free(v))
          targets.emplace_back(v, project_.of_vertex(v));
      move_all(targets);
    }
  }

  Coordinates relaxed(Vertex_index v) {
    star_.collect(mesh_, v);
    return relaxed_place(star_, place(v));
  }

  void move_all(const std::vector<std::pair<Vertex_index, Coordinates>>& targets) {
    for (const auto& [v, target] : targets) {
      star_.collect(mesh_, v);
      if (target == place(v) || !is_smooth_at(star_, place(v)))
        continue;
      if (!goes_on())
        return;
      counted(move(v, target), report_.moves);
    }
  }

  /// As far of the way, of four shares, as the shape allows and is free. \pre star_ is that of v
  bool move(Vertex_index v, const Coordinates& target) {
    const Coordinates from = place(v);
    for (const double share : shares) {
      const Coordinates p = share == 1 ? target : point_of_path(from, target, share);
      if (is_in_range(p) && shape_after_move(star_, from, p) >= 0 && is_smooth_at(star_, p) &&
          sculptor_.move_if_free(v, Point(p[0], p[1], p[2]))) {
        report_.shortened += share != 1;
        return true;
      }
    }
    return false;
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
