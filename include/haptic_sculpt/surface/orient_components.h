// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/surface/Invalid_surface.h>
#include <haptic_sculpt/surface/validate.h>

#include <CGAL/Polygon_mesh_processing/orientation.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace haptic_sculpt {
namespace internal {

/// Whether each face is of a component that these faces are of.
inline std::vector<bool> faces_of_components(const Face_soup& soup,
                                             const std::vector<Validity_report::Face_index>& some) {
  Disjoint_sets sets = Soup_connectivity(soup).components();
  std::vector<bool> root(soup.points.size(), false), found(soup.number_of_faces());
  for (const auto f : some)
    root[sets.find(*soup.begin(static_cast<std::size_t>(f)))] = true;
  for (std::size_t f = 0; f < found.size(); ++f)
    found[f] = root[sets.find(*soup.begin(f))];
  return found;
}

/// Turns components of a valid soup; none of one that is not. \return how many
inline std::size_t turn_components(Face_soup& soup) {
  const auto turned = validate_soup(soup, 0, 1).inside_out_components;
  if (turned.empty())
    return 0;
  const std::vector<bool> turns = faces_of_components(soup, turned);
  for (std::size_t f = 0; f < turns.size(); ++f)
    if (turns[f]) // a face keeps its first corner
      std::swap(soup.corners[soup.first_corner[f] + 1], soup.corners[soup.first_corner[f] + 2]);
  return turned.size();
}

} // namespace internal

/// Turns over each component whose normals point into the solid, so that all components bound a volume: normals point
/// outwards, but inwards, into the cavity, where a component lies in an odd number of others. Nothing else is changed:
/// vertices, faces and properties stay.
/// \return how many components were turned
/// \throw Invalid_surface if validate() finds fault with it, for then in and out are not defined, and Error if a corner
/// is no index of a point; nothing is changed
/// Complexity: that of validate().
inline std::size_t orient_components(Face_soup& soup) {
  const internal::Rounding_to_nearest rounding;
  Validity_report report = validate_soup(soup);
  if (!report.is_valid())
    throw Invalid_surface("the list of faces", std::move(report));
  return internal::turn_components(soup);
}
/// The same of a mesh, in place. A half-edge of what is turned keeps its properties, and has another target: what it
/// held of its target's corner of the face is that of the corner before now. \tparam Mesh
/// `CGAL::Surface_mesh<K::Point_3>` with `K::FT = double`
template <class Mesh>
std::size_t orient_components(Mesh& mesh) {
  const internal::Rounding_to_nearest rounding;
  Validity_report report = validate(mesh);
  if (!report.is_valid())
    throw Invalid_surface("the mesh", std::move(report));
  if (report.inside_out_components.empty())
    return 0;
  std::vector<Face_soup::Index> face_name;
  const Face_soup soup = face_soup(mesh, &face_name);
  std::vector<bool> is_named(mesh.number_of_faces() + mesh.number_of_removed_faces(), false);
  for (const auto f : report.inside_out_components)
    is_named[f] = true;
  std::vector<Validity_report::Face_index> places; // of the named faces in the soup
  for (std::size_t i = 0; i < face_name.size(); ++i)
    if (is_named[face_name[i]])
      places.emplace_back(static_cast<Validity_report::Any_mesh::size_type>(i));
  const std::vector<bool> turns = internal::faces_of_components(soup, places);
  std::vector<typename Mesh::Face_index> faces;
  for (std::size_t i = 0; i < face_name.size(); ++i)
    if (turns[i])
      faces.emplace_back(face_name[i]);
  CGAL::Polygon_mesh_processing::reverse_face_orientations(faces, mesh);
  return places.size();
}

} // namespace haptic_sculpt
