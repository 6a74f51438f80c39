// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/surface/Invalid_surface.h>
#include <haptic_sculpt/surface/io/Is_mesh_of_doubles.h>
#include <haptic_sculpt/surface/Mesh_file_format.h>
#include <haptic_sculpt/surface/connectivity/add_faces.h>
#include <haptic_sculpt/surface/coordinate_range.h>
#include <haptic_sculpt/surface/io/check_regular_file.h>
#include <haptic_sculpt/surface/io/parse_obj.h>
#include <haptic_sculpt/surface/io/parse_off.h>
#include <haptic_sculpt/surface/io/parse_ply.h>
#include <haptic_sculpt/surface/io/parse_stl.h>
#include <haptic_sculpt/surface/io/quoted.h>
#include <haptic_sculpt/surface/validate.h>
#include <haptic_sculpt/surface/vertex_attributes.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace haptic_sculpt {
namespace internal {

/// \throw Read_error
[[gnu::cold]] inline std::string bytes_of_file(const std::filesystem::path& path) {
  check_regular_file(path);
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw Read_error("the file cannot be opened; check its permissions");
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error)
    throw Read_error("the size of the file cannot be read (" + error.message() + ")");
  std::string bytes(size, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file || static_cast<std::size_t>(file.gcount()) != bytes.size())
    throw Read_error("the file cannot be read to its end");
  return bytes;
}

/// \throw Read_error
inline Mesh_file_format format_to_read(const std::filesystem::path& path) {
  const auto format = mesh_file_format(path);
  if (!format)
    throw Read_error("the extension has to be .off, .ply, .obj or .stl");
  return *format;
}

/// \throw Read_error
inline Face_soup parse(std::string_view bytes, Mesh_file_format format) {
  if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw Read_error("the file is empty");
  switch (format) {
  case Mesh_file_format::off:
    return parse_off(without_bom(bytes));
  case Mesh_file_format::ply:
    return parse_ply(without_bom(bytes));
  case Mesh_file_format::obj:
    return parse_obj(without_bom(bytes));
  case Mesh_file_format::stl:
    break;
  }
  return parse_stl(bytes);
}

} // namespace internal

/// The surface as a mesh; vertices and faces keep their indices, and faces their first corners (STL numbers vertices by
/// first appearance, so writing has to begin faces where reading did). Attributes are vertex_attributes(). \pre it is
/// closed, 2-manifold and oriented \throw Error where an attribute has not one value for each point
template <class Mesh>
Mesh mesh_of(const Face_soup& soup) {
  using Vertex = typename Mesh::Vertex_index;
  internal::check_attributes(soup);
  Mesh mesh;
  mesh.reserve(soup.points.size(), soup.corners.size() / 2, soup.number_of_faces());
  for (const auto& p : soup.points)
    mesh.add_vertex(typename Mesh::Point(p.x(), p.y(), p.z()));
  std::vector<std::array<Vertex, 3>> faces(soup.number_of_faces());
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int k = 0; k < 3; ++k)
      faces[f][k] = Vertex(soup.begin(f)[k]);
  for (const Vertex_attribute& attribute : soup.attributes) {
    const auto map = add_vertex_attribute(mesh, attribute.name, attribute.type).map;
    for (std::size_t v = 0; v < soup.points.size(); ++v)
      put(map, Vertex(static_cast<typename Mesh::size_type>(v)), attribute.values[v]);
  }
  internal::add_faces(faces, mesh);
  return mesh;
}

namespace internal {

/// \param bytes returns those of the file, and is called once that is one of a mesh
template <class Bytes>
Face_soup read_face_soup(const std::filesystem::path& path, const Bytes& bytes) {
  const Rounding_to_nearest rounding;
  try {
    const Mesh_file_format format = format_to_read(path);
    Face_soup soup = parse(bytes(), format);
    if (soup.number_of_faces() == 0)
      throw Read_error("the file holds no faces");
    for (std::size_t v = 0; v < soup.points.size(); ++v) {
      const auto& p = soup.points[v];
      const std::array<double, 3> coordinates = {p.x(), p.y(), p.z()};
      if (soup.is_finite(v) && !is_in_range(coordinates)) // what is not finite is named by validate_soup()
        throw_out_of_range("cannot read " + quoted_path(path) + ": vertex " + std::to_string(v) + " at", coordinates);
    }
    return soup;
  } catch (const Read_error& error) {
    throw Read_error("cannot read " + quoted_path(path) + ": " + error.what());
  }
}

} // namespace internal

/// The points and faces of an OFF, PLY, OBJ or STL file, whatever they form. The extension says which format.
///
/// The files are not read through CGAL::IO, because its readers (5.5) allocate what a header asks for, follow the
/// global locale (a comma for a point changes coordinates), do not see data after the last face, and let an OBJ index
/// one beyond the last vertex pass. Here each number is read to the nearest double in the C locale, sizes are checked
/// against the file's before anything is allocated, and errors name the line. The tests compare both on good files.
/// \throw Read_error; Out_of_range if a coordinate is
inline Face_soup read_face_soup(const std::filesystem::path& path) {
  return internal::read_face_soup(path, [&] { return internal::bytes_of_file(path); });
}

/// The same of the bytes of a file, e.g. for who needs their hash. \param path names it, and is not opened
inline Face_soup read_face_soup(const std::filesystem::path& path, std::string_view bytes) {
  return internal::read_face_soup(path, [&] { return bytes; });
}

/// Reads a valid surface from an OFF, PLY (ASCII or binary), OBJ or STL (ASCII or binary) file, or refuses it whole.
///
/// Vertices and faces are numbered from 0 in file order. STL has no vertices: exactly equal corners become one,
/// numbered by first appearance. Decimals are read to the nearest double (in a PLY, to the nearest number of the type
/// that its header gives), so what `write_surface()` wrote comes back bit for bit, whatever rounding mode the caller
/// has set. Colours and other numbers of the vertices of PLY and OBJ are property maps then (vertex_attributes()).
/// Vertices without faces are refused; repair() leaves them out.
///
/// \tparam Mesh `CGAL::Surface_mesh<K::Point_3>` with `K::FT = double`
/// \param path to the file; its extension tells the format
/// \param delta the delta rule's length, >= 0
/// \param left_out if given, receives what the file has and a mesh has not, in words, e.g. "normals"
/// \param found if given, receives what validate() says of the surface, such as components inside out
/// \throw Read_error if the file cannot be read as a mesh; Out_of_range if a coordinate is
/// \throw Invalid_surface if `validate()` finds fault with it; names every offending vertex, edge and face by index (of
/// pairs of intersecting faces the first `Validity_report::default_most_intersections`)
/// \post `validate(mesh, delta).is_valid()`
template <class Mesh>
Mesh read_surface(const std::filesystem::path& path, double delta = 0, std::vector<std::string>* left_out = nullptr,
                  Validity_report* found = nullptr) {
  static_assert(internal::Is_mesh_of_doubles<Mesh>::value,
                "read_surface<Mesh>: Mesh must be a CGAL::Surface_mesh whose points have double coordinates, e.g. "
                "CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>");
  Face_soup soup = read_face_soup(path);
  Validity_report report = validate_soup(soup, delta);
  if (!report.is_valid())
    throw Invalid_surface(internal::quoted_path(path), std::move(report));
  if (left_out != nullptr)
    *left_out = std::move(soup.left_out);
  if (found != nullptr)
    *found = std::move(report);
  if constexpr (internal::Is_mesh_of_doubles<Mesh>::value) // else one message is enough
    return mesh_of<Mesh>(soup);
}

/// The mesh of a valid list of faces, e.g. of one that repair() has repaired. Vertices and faces keep their numbers.
/// \tparam Mesh `CGAL::Surface_mesh<K::Point_3>` with `K::FT = double`
/// \param delta the delta rule's length, >= 0 \param name how messages call it
/// \throw Invalid_surface if `validate_soup()` finds fault with it, Error if a corner is no index of a point
template <class Mesh>
Mesh make_surface(const Face_soup& soup, double delta = 0, const std::string& name = "the list of faces") {
  static_assert(internal::Is_mesh_of_doubles<Mesh>::value,
                "make_surface<Mesh>: Mesh must be a CGAL::Surface_mesh whose points have double coordinates");
  Validity_report report = validate_soup(soup, delta);
  if (!report.is_valid())
    throw Invalid_surface(name, std::move(report));
  return mesh_of<Mesh>(soup);
}

} // namespace haptic_sculpt
