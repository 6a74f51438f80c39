// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/io/Number_writer.h>
#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <CGAL/Cartesian_converter.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace haptic_sculpt::internal {

/// Of length 1 to rounding, however thin the triangle is: CGAL's writer takes the cross product of doubles, which is
/// far off on slivers, and no number where a square overflows or underflows. 0 where the corners are on a line.
[[gnu::cold]] inline std::array<double, 3> facet_normal(const Face_soup& soup, std::size_t face) {
  using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
  const CGAL::Cartesian_converter<Decision_kernel, Exact> exact;
  const Face_soup::Index* const corner = soup.begin(face);
  const Exact::Point_3 a = exact(soup.points[corner[0]]);
  const Exact::Vector_3 normal =
      CGAL::cross_product(exact(soup.points[corner[1]]) - a, exact(soup.points[corner[2]]) - a);
  Exact::FT largest = 0;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max<Exact::FT>(largest, CGAL::abs(normal[axis]));
  if (CGAL::is_zero(largest))
    return {};
  std::array<double, 3> unit{};
  for (int axis = 0; axis < 3; ++axis)
    unit[axis] = CGAL::to_double(Exact::FT(normal[axis] / largest));
  const double length = std::hypot(unit[0], unit[1], unit[2]);
  for (double& x : unit)
    x /= length;
  return unit;
}

/// \pre all faces are triangles; their coordinates are floats where it is binary
[[gnu::cold]] inline std::string format_stl(const Face_soup& soup, bool binary) {
  using Type = Vertex_attribute::Type;
  std::ostringstream out = exact_stream();
  Number_writer writer(out, binary);
  const auto put_point = [&](const char* word, const auto& p) {
    if (!binary)
      out << word << ' ';
    for (int axis = 0; axis < 3; ++axis)
      writer.put(binary ? Type::float32 : Type::float64, p[axis]);
    writer.end_line();
  };
  const auto put_line = [&](const char* text) {
    if (!binary)
      out << text << '\n';
  };
  if (binary) {
    constexpr std::size_t size_of_head = 80;
    out << std::string(size_of_head, ' ');
    writer.put(Type::uint32, static_cast<double>(soup.number_of_faces()));
  }
  put_line("solid");
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    put_point("facet normal", facet_normal(soup, f));
    put_line("outer loop");
    for (const auto* corner = soup.begin(f); corner != soup.end(f); ++corner)
      put_point("vertex", soup.points[*corner]);
    put_line("endloop\nendfacet");
    if (binary)
      writer.put(Type::uint16, 0); // bytes of attributes
  }
  put_line("endsolid");
  return std::move(out).str();
}

} // namespace haptic_sculpt::internal
