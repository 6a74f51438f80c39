// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/io/Number_writer.h>
#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

/// \file
/// PLY and OBJ with attributes of vertices, which CGAL's writers of points and faces do not take.

namespace haptic_sculpt::internal {

/// \pre no face has more than 255 corners where it is binary
[[gnu::cold]] inline std::string format_ply(const Face_soup& soup, bool binary) {
  using Type = Vertex_attribute::Type;
  const std::uint16_t one = 1;
  char first = 0;
  std::memcpy(&first, &one, 1);
  std::ostringstream out = exact_stream();
  out << "ply\nformat "
      << (!binary      ? "ascii"
          : first == 1 ? "binary_little_endian"
                       : "binary_big_endian")
      << " 1.0\nelement vertex " << soup.points.size() << "\nproperty double x\nproperty double y\nproperty double z\n";
  for (const Vertex_attribute& attribute : soup.attributes)
    out << "property " << name_of(attribute.type) << ' ' << attribute.name << '\n';
  out << "element face " << soup.number_of_faces() << "\nproperty list " << (binary ? "uchar" : "uint")
      << " uint vertex_indices\nend_header\n";
  Number_writer writer(out, binary);
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis)
      writer.put(Type::float64, soup.points[v][axis]);
    for (const Vertex_attribute& attribute : soup.attributes)
      writer.put(attribute.type, attribute.values[v]);
    writer.end_line();
  }
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    writer.put(binary ? Type::uint8 : Type::uint32, static_cast<double>(soup.number_of_corners(f)));
    for (const auto* corner = soup.begin(f); corner != soup.end(f); ++corner)
      writer.put(Type::uint32, *corner);
    writer.end_line();
  }
  return std::move(out).str();
}

/// Which attributes are red, green and blue; nothing unless all are there.
inline std::optional<std::array<std::size_t, 3>> colours_of_obj(const Face_soup& soup) {
  std::array<std::size_t, 3> colours{};
  constexpr const char* names[] = {"red", "green", "blue"};
  for (std::size_t k = 0; k < 3; ++k) {
    while (colours[k] < soup.attributes.size() && soup.attributes[colours[k]].name != names[k])
      ++colours[k];
    if (colours[k] == soup.attributes.size())
      return std::nullopt;
  }
  return colours;
}

/// What is divided by for colours from 0 to 1.
inline double largest_colour(Vertex_attribute::Type type) {
  switch (type) {
  case Vertex_attribute::Type::uint8:
    return std::numeric_limits<std::uint8_t>::max();
  case Vertex_attribute::Type::uint16:
    return std::numeric_limits<std::uint16_t>::max();
  case Vertex_attribute::Type::uint32:
    return std::numeric_limits<std::uint32_t>::max();
  default:
    return 1;
  }
}

[[gnu::cold]] inline std::string format_obj(const Face_soup& soup, const std::array<std::size_t, 3>& colours) {
  std::ostringstream out = exact_stream();
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    out << "v " << soup.points[v].x() << ' ' << soup.points[v].y() << ' ' << soup.points[v].z();
    for (const std::size_t colour : colours) {
      const Vertex_attribute& part = soup.attributes[colour];
      out << ' ' << part.values[v] / largest_colour(part.type);
    }
    out << '\n';
  }
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    out << 'f';
    for (const auto* corner = soup.begin(f); corner != soup.end(f); ++corner)
      out << ' ' << *corner + std::size_t{1};
    out << '\n';
  }
  return std::move(out).str();
}

} // namespace haptic_sculpt::internal
