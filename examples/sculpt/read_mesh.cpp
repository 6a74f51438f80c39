// SPDX-License-Identifier: GPL-3.0-or-later
#include "read_mesh.h"
#include "repair_json.h"

#include <haptic_sculpt/surface/io/replace_file.h>
#include <haptic_sculpt/surface/read_surface.h>
#include <haptic_sculpt/surface/repair.h>

#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>

#include <algorithm>
#include <utility>

namespace haptic_sculpt::sculpt_program {
namespace {

/// Two corners, or a corner twice: no polygon.
bool is_polygon(const Face_soup& soup, std::size_t f) {
  std::vector<Face_soup::Index> corners(soup.begin(f), soup.end(f));
  std::sort(corners.begin(), corners.end());
  return corners.size() >= 3 && std::adjacent_find(corners.begin(), corners.end()) == corners.end();
}

/// \throw Read_error where a polygon cannot be divided
Mesh triangulated(const Face_soup& soup, const std::string& path) {
  Mesh mesh;
  for (const auto& p : soup.points)
    mesh.add_vertex({p.x(), p.y(), p.z()});
  std::vector<std::vector<Vertex_index>> faces(soup.number_of_faces());
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const Face_soup::Index* corner = soup.begin(f); corner != soup.end(f); ++corner)
      faces[f].emplace_back(*corner);
  CGAL::Euler::add_faces(faces, mesh);
  // One by one: of them all CGAL does not say which one could not be divided.
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (faces[f].size() > 3 &&
        !CGAL::Polygon_mesh_processing::triangulate_face(Mesh::Face_index(static_cast<Mesh::size_type>(f)), mesh))
      throw Read_error("cannot read '" + path + "': face " + std::to_string(f) +
                       " cannot be divided into triangles; divide it by hand");
  return mesh;
}

} // namespace

Mesh read_repaired(const Arguments& arguments, std::vector<std::string>& left_out, std::string& told) {
  Face_soup soup = read_face_soup(arguments.mesh);
  Repair_parameters parameters;
  parameters.delta(arguments.delta.value_or(0));
  if (arguments.repair.gap)
    parameters.gap(*arguments.repair.gap);
  if (arguments.repair.largest_hole)
    parameters.largest_hole(*arguments.repair.largest_hole);
  const Repair_report report = repair(soup, parameters);
  if (!arguments.repair.report.empty())
    replace_file(arguments.repair.report, json_of(report));
  told = report.message(Validity_report::Reader::user);
  if (!report.is_repaired())
    throw Read_error("cannot repair '" + arguments.mesh + "':\n" + told);
  left_out = std::move(soup.left_out);
  return make_surface<Mesh>(soup, arguments.delta.value_or(0));
}

Mesh read_triangulated(const std::string& path, double delta, std::vector<std::string>& left_out, Validity_report& found) {
  Face_soup soup = read_face_soup(path);
  left_out = std::move(soup.left_out);
  Validity_report report = validate_soup(soup, delta);
  if (!report.is_valid()) {
    Validity_report others = report;
    others.non_triangular_faces.clear();
    const bool are_polygons = std::all_of(report.non_triangular_faces.begin(), report.non_triangular_faces.end(),
                                          [&](const auto f) { return is_polygon(soup, static_cast<std::size_t>(f)); });
    if (!others.is_valid() || !are_polygons)
      throw Invalid_surface("'" + path + "'", std::move(report));
  }
  Mesh mesh = triangulated(soup, path);
  report = validate(mesh, delta);
  if (!report.is_valid())
    throw Invalid_surface("'" + path + "', its faces divided into triangles,", std::move(report));
  found = std::move(report);
  return mesh;
}

} // namespace haptic_sculpt::sculpt_program
