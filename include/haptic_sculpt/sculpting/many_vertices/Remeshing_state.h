// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Remeshing_report.h>
#include <haptic_sculpt/sculpting/edits/Sculptor_access.h>
#include <haptic_sculpt/sculpting/many_vertices/Edge_queue.h>
#include <haptic_sculpt/sculpting/many_vertices/Input_samples.h>
#include <haptic_sculpt/sculpting/many_vertices/Remeshing_marks.h>

namespace haptic_sculpt::internal {

/// What is asked of a remeshing; the names are CGAL's. Lengths are in the unit of the points.
struct Remeshing_named_parameters {
  double target_edge_length = 0;
  double max_distance = 0; ///< may be infinite
  unsigned iterations = 1, relaxation_steps = 1;
  bool protect_constraints = false, collapse_constraints = true, relax_constraints = false;
  bool do_split = true, do_collapse = true, do_flip = true;
};

/// What the phases of a remeshing share.
template <class Sculptor_, class Marks_, class Project_>
struct Remeshing_state {
  using Sculptor = Sculptor_;
  using Marks = Marks_;
  using Project = Project_;
  using Mesh = typename Sculptor::Mesh_type;
  using Vertex_index = typename Mesh::Vertex_index;
  using Edge_index = typename Mesh::Edge_index;
  using Face_index = typename Mesh::Face_index;
  using Point = typename Mesh::Point;

  Remeshing_state(Sculptor& s, const Scaled_points<Mesh>& scaled_points, Marks& m, Project& p,
                  const Remeshing_named_parameters& asked, const Remeshing_parameters& more)
      : sculptor(s)
      , mesh(s.mesh())
      , points(scaled_points)
      , marks(m)
      , project(p)
      , named(asked)
      , parameters(more)
      , low(square(asked.target_edge_length * 4 / 5))
      , high(square(asked.target_edge_length * 4 / 3))
      , samples(asked.max_distance) {}

  Sculptor& sculptor;
  const Mesh& mesh;
  const Scaled_points<Mesh>& points;
  Marks& marks;
  Project& project;
  const Remeshing_named_parameters& named;
  const Remeshing_parameters& parameters;
  double low, high; ///< squares of the lengths at which edges are collapsed and split
  Input_samples<Mesh> samples;
  Remeshing_report report;
  Remeshing_progress::Phase phase = Remeshing_progress::Phase::split;
  std::size_t operations = 0;
  Star<Mesh> star; ///< the one at hand, its points in the unit

  Coordinates place(Vertex_index v) const { return points(v); }
  double length(Edge_index e) const { return points.squared_length(e); }
  /// To be handed to the Sculptor.
  Point point(const Coordinates& p) const {
    const Coordinates q = points.in_mesh(p);
    return {q[0], q[1], q[2]};
  }
  void collect(Vertex_index v) { points.collect(star, v); }

  /// Asks the progress function whether to go on.
  bool is_wanted() {
    if (!report.cancelled && parameters.progress_function)
      report.cancelled = !ask(Sculptor_access::guarded(sculptor), parameters.progress_function,
                              Remeshing_progress{report.iterations, phase, operations});
    return !report.cancelled;
  }
  /// Before an operation: whether it may be made.
  bool goes_on() {
    if (operations % Remeshing_parameters::operations_between_calls == 0)
      is_wanted();
    ++operations;
    return !report.cancelled;
  }

  static bool counted(bool done, Remeshing_report::Count& count) {
    ++(done ? count.done : count.refused);
    return done;
  }

  /// Whether the input stays near enough when the vertex of the star, whose samples are in hand, goes to `to`, and the
  /// faces with the link's vertex `without` are no more.
  bool keeps_near(const Coordinates& to, std::size_t without = static_cast<std::size_t>(-1)) {
    const Coordinates from = place(star.centre);
    const auto to_face = [&](const Coordinates& p, const Coordinates& top, std::size_t i) {
      return squared_distance_to_triangle(p, top, star.link_points[star.next(i)], star.link_points[i]);
    };
    const bool is_near = samples.fit(
        star.valence(),
        [&](const Coordinates& p, std::size_t i) {
          return i == without || star.next(i) == without ? std::numeric_limits<double>::infinity() : to_face(p, to, i);
        },
        [&](const Coordinates& p, std::size_t i) { return to_face(p, from, i); });
    report.too_far += !is_near;
    return is_near;
  }

private:
  static double square(double x) { return x * x; }
};

} // namespace haptic_sculpt::internal
