// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Sculptor.h>
#include <haptic_sculpt/sculpting/many_vertices/Rigid_mover.h>

#include <CGAL/Aff_transformation_3.h>

namespace haptic_sculpt {

/// Moves vertices, an object of the scene as a rule, by a translation or by a rotation of less than half a turn, as far
/// as that is free, and no farther: it does not slide.
///
/// \tparam Concurrency_tag as of move_vertices()
/// \param vertices a range of vertices, const; one that is given again counts once
/// \param transformation of the kernel of the mesh's points. Where all of the way is gone, each vertex is at what
/// `transformation.transform()` makes of its point, as numbers
/// \param parameters as of move_vertices(): `most_drags`, `most_pairs`, `progress` end it where it stands; the others
/// do not count
///
/// The way is a straight one or an arc. It is gone in steps of at least a 1024th, made by all vertices or by none; each
/// is an axis move along x, one along y and one along z to places on the way, so that between steps what moves may be
/// sheared (doc/use/many_vertices.md). Nothing meets anything at any time, proven. The whole is one stroke, one step of
/// the history; none, where nothing has moved. \throw Invalid_parameter where the transformation is something else,
/// Unknown_vertex, Out_of_range: nothing has moved; Mesh_changed; std::bad_alloc, and what the visitor and the progress
/// function throw: the step at hand is taken back, unless it was made. Cost: some microseconds a vertex where the way
/// is free; where it is blocked, some twenty times that.
template <class Concurrency_tag = CGAL::Sequential_tag, class Sculptor, class Vertex_range>
Rigid_move_report<typename Sculptor::Mesh_type> move_rigidly(
    Sculptor& sculptor, const Vertex_range& vertices,
    const CGAL::Aff_transformation_3<typename CGAL::Kernel_traits<typename Sculptor::Point>::Kernel>& transformation,
    const Move_parameters& parameters = Move_parameters()) {
  const internal::Rounding_to_nearest rounding;
  std::array<internal::Vector, 3> linear;
  internal::Vector shift;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      linear[i][j] = transformation.m(i, j);
    shift[i] = transformation.m(i, 3);
  }
  const internal::Rigid_way way(linear);
  const auto moving = internal::moving_vertices(
      sculptor.mesh(), vertices, [&](auto v) { return transformation.transform(sculptor.mesh().point(v)); });
  double size = 0;
  for (const auto& v : moving)
    size = std::max({size, internal::largest_magnitude(v.source), internal::largest_magnitude(v.target)});
  way.check_shift(shift, size);
  Rigid_move_report<typename Sculptor::Mesh_type> report;
  report.asked = moving.size();
  const auto stroke = sculptor.stroke();
  internal::Rigid_mover<Sculptor>(sculptor, moving, way, parameters, report, Part_runner::by<Concurrency_tag>()).run();
  return report;
}

} // namespace haptic_sculpt
