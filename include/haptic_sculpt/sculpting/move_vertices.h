// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Sculptor.h>
#include <haptic_sculpt/sculpting/many_vertices/Vertices_mover.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <CGAL/Iterator_range.h>
#include <CGAL/iterator.h>

namespace haptic_sculpt {
namespace internal {

/// \throw Invalid_parameter where the clearance does not serve where the targets are
template <class Mesh>
void check_clearance_at_targets(const std::vector<Moving_vertex<Mesh>>& moving,
                                const std::optional<double>& clearance) {
  double largest = 0;
  for (const auto& v : moving)
    largest = std::fmax(largest, largest_magnitude(v.target));
  if (clearance && *clearance < unit_in_the_last_place(largest))
    throw Invalid_parameter("the clearance " + number(*clearance) +
                            " does not serve where the targets are: give at least " +
                            number(unit_in_the_last_place(largest)) + " (an ulp of their largest coordinate), or none");
}

/// Tells of the distances from where the vertices are to their targets.
template <class Mesh>
void measure_distances(const Mesh& mesh, const std::vector<Moving_vertex<Mesh>>& moving, double& l2, double& largest) {
  largest = 0;
  for (const auto& v : moving)
    largest = std::fmax(largest, distance(vertex_coordinates(mesh, v.vertex), v.target));
  double sum = 0; // of squares of shares, lest they overflow
  for (const auto& v : moving) {
    const double share = largest > 0 ? distance(vertex_coordinates(mesh, v.vertex), v.target) / largest : 0;
    sum += share * share;
  }
  l2 = largest * std::sqrt(sum);
}

/// As move_vertices(). \param target_of `target_of(v)`, asked of each vertex once, in their order \param run who shares
/// the work of axis moves
template <class Sculptor, class Vertex_range, class Target_of, class Output_iterator>
Move_report move_to_targets(Sculptor& sculptor, const Vertex_range& vertices, Target_of target_of,
                            const Move_parameters& parameters, Output_iterator left_behind,
                            const Part_runner& run = Part_runner()) {
  const auto asked = moving_vertices(sculptor.mesh(), vertices, target_of);
  if (parameters.drags_singly && !asked.empty()) { // drags would ask when others have moved
    check_clearance_at_targets(asked, sculptor.parameters().drag.clearance_length);
    Sculptor_access::guarded(sculptor).check_clearance_serves();
  }
  Move_report report;
  report.asked = asked.size();
  measure_distances(sculptor.mesh(), asked, report.asked_l2, report.asked_max);
  {
    const auto stroke = sculptor.stroke();
    Vertices_mover<Sculptor>(sculptor, asked, parameters, report, run).run();
  }
  measure_distances(sculptor.mesh(), asked, report.left_l2, report.left_max);
  // Each distance is exactly no longer than it was; its root may be rounded up.
  report.left_l2 = std::fmin(report.left_l2, report.asked_l2);
  report.left_max = std::fmin(report.left_max, report.asked_max);
  for (const auto& v : asked)
    if (vertex_coordinates(sculptor.mesh(), v.vertex) == v.target)
      ++report.reached;
    else
      ask(Sculptor_access::guarded(sculptor), [&] { *left_behind++ = v.vertex; });
  report.out_of_work = report.out_of_work && report.left() > 0; // drags may have done what an axis move was not to
  return report;
}

} // namespace internal

/// Moves vertices as near to their targets as axis moves and drags bring them, each proven: no surface passes through a
/// surface on the way, and no vertex ends farther from its target than it was.
///
/// \tparam Concurrency_tag `CGAL::Sequential_tag` (the default), `CGAL::Parallel_tag` or
/// `CGAL::Parallel_if_available_tag`: whether oneTBB's threads share the work of axis moves; the same bits either way
/// \param vertices a range of vertices, const; one that is given again counts once
/// \param target_map a model of `ReadablePropertyMap` from vertices to points
/// \param left_behind an output iterator for the vertices that are not at their targets at the end, in the order
/// given; it may look, and not edit
///
/// All targets are read and checked before the first vertex moves. The whole is one stroke, one step of the history;
/// none, where nothing has moved. Its own response is used, that of the Sculptor is as before afterwards.
/// doc/proofs/many_vertices.md tells how the vertices are brought on, and which do not arrive: few that stay behind, up
/// to one and a 32nd of all, slide after the others, and may end far from their targets although these are free.
/// \throw Unknown_vertex, Out_of_range, Invalid_parameter: nothing has moved, unless a slide then ends beyond a power
/// of two that no vertex and no target is beyond, and the clearance is below an ulp there; Mesh_changed,
/// std::bad_alloc, and what the progress function throws: what has moved by then stays so. Cost: some microseconds a
/// vertex where the targets are free; about a millisecond for one that has to slide.
template <class Concurrency_tag = CGAL::Sequential_tag, class Sculptor, class Vertex_range, class Target_map,
          class Output_iterator = CGAL::Emptyset_iterator>
Move_report move_vertices(Sculptor& sculptor, const Vertex_range& vertices, const Target_map& target_map,
                          const Move_parameters& parameters = Move_parameters(),
                          Output_iterator left_behind = Output_iterator()) {
  const internal::Rounding_to_nearest rounding;
  auto& guarded = internal::Sculptor_access::guarded(sculptor);
  using Target = typename boost::property_traits<Target_map>::value_type;
  const auto target = [&](auto v) -> Target { return get(target_map, v); };
  return internal::move_to_targets(
      sculptor, vertices, [&](auto v) { return internal::ask(guarded, target, v); }, parameters, left_behind,
      Part_runner::by<Concurrency_tag>());
}

} // namespace haptic_sculpt
