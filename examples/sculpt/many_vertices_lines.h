// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_MANY_VERTICES_LINES_H
#define HAPTIC_SCULPT_EXAMPLES_MANY_VERTICES_LINES_H

#include "Run_result.h"

#include <cmath>
#include <sstream>
#include <unordered_map>

/// \file
/// The lines `brush` and `remesh` of a script. Each is one step of undo.

namespace haptic_sculpt::sculpt_program {

/// What became of such a line.
struct Many_vertices_outcome {
  const char* refusal = nullptr;    ///< nothing was done, for this reason
  std::size_t asked = 0, done = 0;  ///< brush: vertices, and those at their targets; remesh: operations
  std::string detail;               ///< for people
};

/// A dab with a brush.
template <class Sculptor>
Many_vertices_outcome carry_out_brush(Sculptor& sculptor, const Command& command) {
  std::unordered_map<Vertex_index, Kernel::Point_3> places;
  const boost::associative_property_map<decltype(places)> targets(places);
  const auto vertices = brushes::fill_targets(sculptor.mesh(), dab_of(command), targets);
  if (vertices.empty())
    return {"nothing-in-reach", 0, 0, "no vertex is nearer to the centre than the radius"};
  try {
    const Move_report report = move_vertices(sculptor, vertices, targets, Move_parameters().steps(false));
    std::ostringstream detail;
    detail.precision(3);
    detail << report.reached << " of " << report.asked << " vertices arrived";
    if (report.reached != report.asked)
      detail << ", " << 100 * (1 - report.left_l2 / report.asked_l2) << " % of the way was gone";
    return {nullptr, report.asked, report.reached, detail.str()};
  } catch (const Out_of_range& error) {
    return {"out-of-range", 0, 0, error.what()};
  } catch (const Invalid_parameter& error) {
    return {"clearance-of-no-use", 0, 0, error.what()};
  }
}

/// Remeshes all of it to edges of about a length.
template <class Sculptor>
Many_vertices_outcome carry_out_remesh(Sculptor& sculptor, const Command& command) {
  const Mesh& mesh = sculptor.mesh();
  const double length = command.length;
  double triangles = 0; // equilateral ones
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const auto p = mesh.point(mesh.source(h));
    const auto normal = CGAL::cross_product(mesh.point(mesh.target(h)) - p, mesh.point(mesh.target(mesh.next(h))) - p);
    triangles += std::sqrt((normal / length / length).squared_length()) * (2 / std::sqrt(3.));
  }
  constexpr double most_triangles = 2e7; // some 800 bytes each: what a machine of 16 GiB holds
  if (!(triangles <= most_triangles))
    return {"too-many-triangles", 0, 0, "edges of this length would make more than 20 million triangles of it"};
  const Remeshing_report report = isotropic_remeshing(sculptor, length, CGAL::parameters::number_of_iterations(3));
  std::size_t done = 0, refused = 0;
  std::ostringstream detail;
  const auto tell = [&](const char* what, const Remeshing_report::Count& count) {
    done += count.done;
    refused += count.refused;
    detail << (detail.tellp() == 0 ? "" : ", ") << count.done << ' ' << what;
    if (count.refused != 0)
      detail << " (" << count.refused << " refused)";
  };
  tell("splits", report.splits);
  tell("collapses", report.collapses);
  tell("flips", report.flips);
  tell("moves", report.moves);
  return {nullptr, done + refused, done, detail.str()};
}

} // namespace haptic_sculpt::sculpt_program

#endif
