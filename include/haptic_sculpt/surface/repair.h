// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/no_fast_math.h>
#include <haptic_sculpt/surface/io/Is_mesh_of_doubles.h>
#include <haptic_sculpt/surface/coordinate_range.h>
#include <haptic_sculpt/surface/read_surface.h>
#include <haptic_sculpt/surface/repair/copy_attributes.h>
#include <haptic_sculpt/surface/repair/Repairer.h>

#include <algorithm>
#include <string>
#include <utility>

namespace haptic_sculpt {
namespace internal {

/// \throw Out_of_range, Error. \return a report of the points that are not finite, if there are any
inline Validity_report check_repairable(const Face_soup& soup, const Repair_parameters& parameters) {
  const double gap = parameters.gap_length.value_or(0);
  if (!(gap >= 0) || !is_in_range(gap))
    throw Out_of_range("gap " + number(gap) +
                       " is out of range: give a length >= 0 and at most 2^1000, about 1.07e301");
  check_length_of_delta(parameters.delta_length);
  check_corners(soup);
  check_attributes(soup);
  Validity_report report;
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    if (!soup.is_finite(v))
      report.non_finite_vertices.emplace_back(static_cast<Validity_report::Any_mesh::size_type>(v));
    else if (const auto& p = soup.points[v]; !is_in_range({p.x(), p.y(), p.z()}))
      throw_out_of_range("cannot repair: vertex " + std::to_string(v) + " at", {p.x(), p.y(), p.z()});
  return report;
}

/// What repair() does, without a change where there is nothing to do. \param result receives the repaired soup
inline Repair_report repaired(const Face_soup& soup, const Repair_parameters& parameters, Face_soup& result) {
  Repair_report report;
  report.left = check_repairable(soup, parameters);
  if (!report.left.is_valid()) {
    report.attempt = soup;
    return report;
  }
  Repairer repairer(soup, parameters);
  report = repairer.run();
  (report.is_repaired() ? result : report.attempt) = std::move(repairer.soup());
  return report;
}

} // namespace internal

/// Makes a valid surface of whatever a file holds, as far as CGAL's functions can: a soup of faces, with holes, gaps,
/// doubled, turned and degenerate faces, self-intersections, overlapping solids. doc/use/repair.md says what is done,
/// in which order, and what comes through.
///
/// All is done on a copy. Where faults are left, the soup is unchanged, and the report says which. Where there is no
/// fault, no component inside out and no point without a face, the soup is unchanged, too.
///
/// \throw Out_of_range if a coordinate or the gap is; Error if a corner is no index of a point, or delta no
/// length; nothing is changed
/// \post `report.is_repaired()` and `validate_soup(soup, delta).is_valid()`, or the soup is unchanged
/// Complexity: O(n log^3 n) and what CGAL's functions take where there are faults; a hole of h <= 500 edges up to
/// O(h^3).
inline Repair_report repair(Face_soup& soup, const Repair_parameters& parameters = {}) {
  const internal::Rounding_to_nearest rounding;
  Face_soup result;
  Repair_report report = internal::repaired(soup, parameters, result);
  if (report.is_repaired() && !report.steps.empty()) {
    internal::copy_attributes(soup, result); // which may throw
    result.left_out = std::move(soup.left_out);
    soup = std::move(result);
  }
  return report;
}

/// The same of a mesh, in place. Where it was changed it is a new mesh: indices, properties and handles to them are not
/// those it had; where only components were turned, it is the same mesh.
/// \tparam Mesh `CGAL::Surface_mesh<K::Point_3>` with `K::FT = double`
/// \throw Error also if its half-edges contradict each other. Points are numbered without removed vertices
template <class Mesh>
Repair_report repair(Mesh& mesh, const Repair_parameters& parameters = {}) {
  static_assert(internal::Is_mesh_of_doubles<Mesh>::value,
                "repair(mesh): it must be a CGAL::Surface_mesh whose points have double coordinates");
  const internal::Rounding_to_nearest rounding;
  if (!internal::inconsistent_elements(mesh).empty())
    throw Error("cannot repair: the half-edges of the mesh contradict each other; give its points and faces as a "
                "Face_soup");
  Face_soup soup = face_soup(mesh), result;
  if (mesh.has_garbage()) // removed vertices are no points
    internal::keep_points(soup, mesh.vertices());
  Repair_report report = internal::repaired(soup, parameters, result);
  // A list of faces does not know that they are open: the mesh that is made of it has them sewn.
  if (const std::size_t seams = report.is_repaired() ? internal::open_seams(mesh).size() : 0; seams != 0)
    report.steps.insert(report.steps.begin(),
                        {Repair_kind::stitch_edges, {{"pairs of open edges stitched", seams / 2}}, 0, {}});
  const auto turns = [](const Repair_step& step) { return step.kind == Repair_kind::orient_solids; };
  if (!report.is_repaired() || report.steps.empty())
    return report;
  if (std::all_of(report.steps.begin(), report.steps.end(), turns))
    orient_components(mesh);
  else
    mesh = mesh_of<Mesh>(result);
  return report;
}

} // namespace haptic_sculpt
