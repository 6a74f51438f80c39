// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/surface/Invalid_surface.h>
#include <haptic_sculpt/surface/io/Is_mesh_of_doubles.h>
#include <haptic_sculpt/surface/Mesh_file_format.h>
#include <haptic_sculpt/surface/io/format_attributes.h>
#include <haptic_sculpt/surface/io/format_stl.h>
#include <haptic_sculpt/surface/io/parse_ply.h>
#include <haptic_sculpt/surface/io/replace_file.h>
#include <haptic_sculpt/surface/validate.h>
#include <haptic_sculpt/surface/vertex_attributes.h>
#include <haptic_sculpt/to_float.h>

#include <boost/range/iterator_range.hpp>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <locale>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace haptic_sculpt {

/// How `write_surface()` writes, named and chained: `Write_parameters().allow_rounding()`.
struct Write_parameters {
  /// Whether numbers are written as text or as bytes.
  enum class Encoding {
    automatic, ///< binary for PLY, ASCII for OFF, OBJ and STL: the smallest that is lossless
    ascii,     ///< numbers of 17 digits, which bring every double back
    binary     ///< PLY and STL only
  };
  Encoding encoding_kind = Encoding::automatic;              ///< encoding()
  bool is_rounding_allowed = false;                          ///< allow_rounding()
  std::vector<Validity_report::Vertex_index> vertices_order; ///< vertex_order()

  /// Binary OFF and OBJ are refused.
  Write_parameters& encoding(Encoding kind) {
    encoding_kind = kind;
    return *this;
  }
  /// Allows binary STL to round coordinates to floats, if the rounded surface is still valid.
  Write_parameters& allow_rounding(bool on = true) {
    is_rounding_allowed = on;
    return *this;
  }
  /// The order in which vertices are written. Empty: by index. Otherwise every vertex of the mesh stands in it once.
  Write_parameters& vertex_order(std::vector<Validity_report::Vertex_index> order) {
    vertices_order = std::move(order);
    return *this;
  }
};

/// "automatic", "ascii" or "binary".
inline const char* name_of(Write_parameters::Encoding encoding) {
  constexpr const char* names[] = {"automatic", "ascii", "binary"};
  return names[static_cast<int>(encoding)];
}

namespace internal {

/// The vertices in the order asked for, closed up. \throw Write_error
template <class Mesh>
std::vector<typename Mesh::Vertex_index> written_order(const Mesh& mesh, const Write_parameters& parameters) {
  using Vertex = typename Mesh::Vertex_index;
  if (parameters.vertices_order.empty())
    return {mesh.vertices().begin(), mesh.vertices().end()};
  std::vector<Vertex> order;
  std::vector<bool> seen(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), false);
  for (const auto index : parameters.vertices_order) {
    const Vertex v(static_cast<std::size_t>(index));
    if (!mesh.has_valid_index(v) || mesh.is_removed(v) || seen[v])
      throw Write_error("the vertex order names vertex " + std::to_string(std::size_t(index)) +
                        (mesh.has_valid_index(v) && seen[v] ? " twice" : ", which the mesh does not have"));
    seen[v] = true;
    order.push_back(v);
  }
  if (order.size() != mesh.number_of_vertices())
    throw Write_error("the vertex order names " + std::to_string(order.size()) + " of " +
                      std::to_string(mesh.number_of_vertices()) + " vertices");
  return order;
}

/// \throw Write_error if STL cannot hold the elements, which it names as the mesh does
template <class Mesh>
void check_elements_for_stl(const Mesh& mesh) {
  std::vector<bool> has_face(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), false);
  for (const auto f : mesh.faces())
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      has_face[v] = true;
  for (const auto v : mesh.vertices())
    if (!has_face[v])
      throw Write_error("STL holds no vertices without faces, such as vertex " + std::to_string(std::size_t(v)) +
                        "; remove it, or write PLY, OFF or OBJ");
  for (const auto f : mesh.faces())
    if (mesh.degree(f) != 3)
      throw Write_error("STL holds triangles only, but face " + std::to_string(std::size_t(f)) + " has " +
                        std::to_string(mesh.degree(f)) + " corners");
}

/// The same of binary PLY, which counts corners by a byte.
template <class Mesh>
void check_elements_for_binary_ply(const Mesh& mesh) {
  for (const auto f : mesh.faces())
    if (mesh.degree(f) > 255)
      throw Write_error("face " + std::to_string(std::size_t(f)) +
                        " has more than the 255 corners of binary PLY; write OFF or OBJ");
}

/// The mesh as it will be written. \pre its connectivity does not contradict itself
/// \throw Write_error if no format can hold it
template <class Mesh>
Face_soup compacted(const Mesh& mesh, const Write_parameters& parameters) {
  Face_soup soup = face_soup(mesh);
  const auto order = written_order(mesh, parameters);
  for (const auto v : order)
    if (!soup.is_finite(v))
      throw Write_error("vertex " + std::to_string(std::size_t(v)) + " has a coordinate that is not finite");
  keep_points(soup, order);
  for (const auto& attribute : vertex_attributes(mesh)) {
    soup.attributes.push_back({attribute.name, attribute.type, {}});
    for (const auto v : order)
      soup.attributes.back().values.push_back(rounded_to(attribute.type, get(attribute.map, v)));
  }
  return soup;
}

inline Face_soup rounded_to_float(Face_soup soup) {
  for (auto& p : soup.points)
    p = {to_float(p.x()), to_float(p.y()), to_float(p.z())};
  return soup;
}

/// \throw Write_error if binary STL cannot hold the coordinates without loss, and loss is not allowed
[[gnu::cold]] inline void round_for_binary_stl(Face_soup& soup, bool allow_rounding) {
  Face_soup rounded = rounded_to_float(soup);
  if (rounded.points == soup.points)
    return;
  if (!allow_rounding)
    throw Write_error(
        "binary STL holds floats, and the coordinates do not fit in them; write ASCII STL or PLY, or allow "
        "rounding");
  if (const Validity_report report = validate_soup(rounded); !report.is_valid())
    throw Write_error("rounded to the floats of binary STL the surface is no longer valid; write ASCII STL or PLY "
                      "(faces in the order of the file, vertices in that of the mesh, or as asked for):\n" +
                      report.message());
  soup = std::move(rounded);
}

/// Whether a face has more corners than a byte can count.
inline bool is_beyond_byte(const Face_soup& soup) {
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    if (soup.number_of_corners(f) > 255)
      return true;
  return false;
}

/// \throw Write_error if a header of PLY cannot name an attribute
inline void check_attributes_for_ply(const Face_soup& soup) {
  std::set<std::string> names = {"x", "y", "z"};
  if (names.size() + soup.attributes.size() > most_names)
    throw Write_error("vertices have " + std::to_string(soup.attributes.size()) + " attributes, of which a PLY file " +
                      "holds " + std::to_string(most_names - names.size()) + "; remove some");
  for (const Vertex_attribute& attribute : soup.attributes) {
    const bool is_word = is_single_word(attribute.name);
    const bool is_normal = attribute_in_words(attribute.name) == "normals"; // they are not read
    if (!is_word || is_normal || !names.insert(attribute.name).second)
      throw Write_error("PLY cannot name the attribute " + in_quotes(attribute.name) + " of vertices: it " +
                        (is_normal ? "would be a normal"
                         : is_word ? "stands there already"
                                   : "is no single word") +
                        "; give it another name");
  }
}

/// The text or bytes of the file, by CGAL's writers as far as they can say it. They are given a stream of their own, in
/// the C locale and with 17 digits, which bring every double back.
[[gnu::cold]] inline std::string file_contents(const Face_soup& soup, Mesh_file_format format, bool binary) {
  if (format == Mesh_file_format::ply && // CGAL counts corners by bytes, as text, too
      (!soup.attributes.empty() || is_beyond_byte(soup)))
    return format_ply(soup, binary);
  if (format == Mesh_file_format::stl)
    return format_stl(soup, binary);
  if (const auto colours = colours_of_obj(soup); format == Mesh_file_format::obj && colours)
    return format_obj(soup, *colours);
  std::vector<boost::iterator_range<const Face_soup::Index*>> faces;
  faces.reserve(soup.number_of_faces());
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    faces.emplace_back(soup.begin(f), soup.end(f));
  std::ostringstream out = exact_stream();
  CGAL::IO::set_mode(out, binary ? CGAL::IO::BINARY : CGAL::IO::ASCII);
  const auto digits = CGAL::parameters::stream_precision(std::numeric_limits<double>::max_digits10);
  bool written = false;
  if (format == Mesh_file_format::off)
    written = CGAL::IO::write_OFF(out, soup.points, faces, digits);
  else if (format == Mesh_file_format::ply)
    written = CGAL::IO::write_PLY(out, soup.points, faces, digits);
  else
    written = CGAL::IO::write_OBJ(out, soup.points, faces, digits);
  if (!written)
    throw Write_error("CGAL's writer failed");
  return std::move(out).str();
}

} // namespace internal

/// The bytes of the file that write_surface() writes. \tparam Mesh `CGAL::Surface_mesh<K::Point_3>` with
/// `K::FT = double` \throw Write_error
template <class Mesh>
std::string surface_bytes(const Mesh& mesh, Mesh_file_format format, const Write_parameters& parameters = {}) {
  static_assert(internal::Is_mesh_of_doubles<Mesh>::value,
                "write_surface(), surface_bytes(): the mesh must be a CGAL::Surface_mesh whose points have double "
                "coordinates");
  const internal::Rounding_to_nearest rounding;
  using Encoding = Write_parameters::Encoding;
  const bool may_be_binary = format == Mesh_file_format::ply || format == Mesh_file_format::stl;
  if (parameters.encoding_kind == Encoding::binary && !may_be_binary)
    throw Write_error("only PLY and STL are written in binary");
  const bool binary = parameters.encoding_kind == Encoding::binary ||
                      (parameters.encoding_kind == Encoding::automatic && format == Mesh_file_format::ply);
  if (!internal::inconsistent_elements(mesh).empty())
    throw Write_error("the connectivity of the mesh contradicts itself; see validate()");
  const bool is_stl = format == Mesh_file_format::stl, is_ply = format == Mesh_file_format::ply;
  if (is_stl)
    internal::check_elements_for_stl(mesh);
  if (is_ply && binary)
    internal::check_elements_for_binary_ply(mesh);
  Face_soup soup = internal::compacted(mesh, parameters);
  if (is_stl && binary)
    internal::round_for_binary_stl(soup, parameters.is_rounding_allowed);
  if (is_ply)
    internal::check_attributes_for_ply(soup);
  return internal::file_contents(soup, format, binary);
}

/// The same for the file of this name. \throw Write_error which names it
template <class Mesh>
std::string surface_bytes(const Mesh& mesh, const std::filesystem::path& path,
                          const Write_parameters& parameters = {}) {
  try {
    if (const auto format = mesh_file_format(path))
      return surface_bytes(mesh, *format, parameters);
    throw Write_error("the extension has to be .off, .ply, .obj or .stl");
  } catch (const Write_error& error) {
    throw Write_error("cannot write " + internal::quoted_path(path) + ": " + error.what());
  }
}

/// Writes a mesh without loss and atomically: the file is there whole, or what was there before is as it was.
///
/// The extension says which format: .off, .ply, .obj or .stl. Coordinates come back bit for bit through
/// `read_surface()` from every format but binary STL, which holds floats: there it is refused unless the coordinates
/// are floats anyway, or `allow_rounding()` is set and the rounded surface validates. ASCII STL holds 17 digits and is
/// lossless, but numbers vertices anew, in order of first appearance. Removed elements are left out; vertices close up
/// in index order or in `vertex_order()`, faces in index order. PLY holds all vertex_attributes(), and refuses names
/// that are no single word, stand there twice or would be a normal, and more than 997; OBJ holds colours, the other
/// formats none (`attributes_not_held()`). An invalid surface is written as it is (and will
/// not be read back, nor is an empty one), unless the format cannot hold it. STL joins vertices at one place.
///
/// \tparam Mesh `CGAL::Surface_mesh<K::Point_3>` with `K::FT = double`
/// \param path of the file; its folder has to exist. `replace_file()` says what becomes of links and permissions
/// \throw Write_error
template <class Mesh>
void write_surface(const std::filesystem::path& path, const Mesh& mesh, const Write_parameters& parameters = {}) {
  replace_file(path, surface_bytes(mesh, path, parameters));
}

} // namespace haptic_sculpt
