// SPDX-License-Identifier: GPL-3.0-or-later
#include "read_mesh.h"

#include "refusal.h"

#include <haptic_sculpt/surface/divide_polygon.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace haptic_sculpt::sculpt_program {
namespace {

/// Two corners, or a corner twice: no polygon.
bool is_polygon(const Face_soup& soup, std::size_t f) {
  std::vector<Face_soup::Index> corners(soup.begin(f), soup.end(f));
  std::sort(corners.begin(), corners.end());
  return corners.size() >= 3 && std::adjacent_find(corners.begin(), corners.end()) == corners.end();
}

/// Of each face the first triangle takes its place, the others follow behind all faces.
/// \throw Read_error where a polygon cannot be divided
Face_soup triangulated(const Face_soup& soup, const Arguments& arguments) {
  Face_soup result;
  result.points = soup.points, result.attributes = soup.attributes;
  std::vector<std::array<Face_soup::Index, 3>> others;
  Validity_report undivided;
  undivided.delta = arguments.delta.value_or(0);
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    const Face_soup::Index* const corner = soup.begin(f);
    if (soup.number_of_corners(f) == 3) {
      result.add_face(std::array<Face_soup::Index, 3>{corner[0], corner[1], corner[2]});
      continue;
    }
    std::vector<std::array<double, 3>> places;
    for (const Face_soup::Index* c = corner; c != soup.end(f); ++c)
      places.push_back({soup.points[*c].x(), soup.points[*c].y(), soup.points[*c].z()});
    const auto triangles = divided_polygon(places);
    if (!triangles) {
      undivided.non_triangular_faces.emplace_back(static_cast<Face_soup::Index>(f));
      continue;
    }
    for (const Corners_of_triangle& t : *triangles) {
      const std::array<Face_soup::Index, 3> triangle{corner[t[0]], corner[t[1]], corner[t[2]]};
      if (&t == &triangles->front())
        result.add_face(triangle);
      else
        others.push_back(triangle);
    }
  }
  if (const auto& faces = undivided.non_triangular_faces; !faces.empty()) {
    write_refusal(arguments, soup, undivided);
    const auto f = static_cast<std::size_t>(faces.front());
    const std::string more = faces.size() > 1 ? " (and " + std::to_string(faces.size() - 1) + " more)" : "";
    throw Read_error("cannot read '" + arguments.mesh + "': face " + std::to_string(f) + more + ", of " +
                     std::to_string(soup.number_of_corners(f)) +
                     " corners, cannot be divided into triangles, as it folds over itself or has all its corners on "
                     "a line: along no axis it is seen as a simple polygon. Divide it by hand");
  }
  for (const auto& triangle : others)
    result.add_face(triangle);
  return result;
}

} // namespace

Sculpted_mesh read_mesh(const examples::Mesh_file& file, const Arguments& arguments) {
  const std::string& path = arguments.mesh;
  const double delta = arguments.delta.value_or(0);
  Face_soup soup = file.soup();
  Sculpted_mesh read;
  read.left_out = std::move(soup.left_out);
  const auto refuse = [&](const std::string& subject, Validity_report report) {
    if (!arguments.report.empty() || !arguments.picture.empty())
      write_refusal(arguments, soup,
                    report.has_more_intersections ? validate_soup(soup, delta, Validity_report::all_intersections)
                                                  : report);
    throw Invalid_surface(subject, std::move(report));
  };
  Validity_report report = validate_soup(soup, delta);
  if (!report.is_valid()) {
    Validity_report others = report;
    others.non_triangular_faces.clear();
    const bool are_polygons = std::all_of(report.non_triangular_faces.begin(), report.non_triangular_faces.end(),
                                          [&](const auto f) { return is_polygon(soup, static_cast<std::size_t>(f)); });
    if (!arguments.triangulate || !others.is_valid() || !are_polygons)
      refuse("'" + path + "'", std::move(report));
    soup = triangulated(soup, arguments); // and looked at again
    read.is_changed = true;
    report = validate_soup(soup, delta);
    if (!report.is_valid())
      refuse("'" + path + "', its faces divided into triangles,", std::move(report));
  }
  read.found = std::move(report);
  read.mesh = mesh_of<Mesh>(soup);
  return read;
}

} // namespace haptic_sculpt::sculpt_program
