// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../common/write_file.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <map>

namespace haptic_sculpt::window_program {

/// A ball of radius 1 to begin with, of 8 n^2 triangles: an octahedron, blown up. Its mirror images in the planes of
/// coordinates are itself, to the bit.
inline void write_ball(const std::string& path, int n = 71) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  CGAL::Surface_mesh<Point> mesh;
  using Place = std::array<int, 3>;
  std::map<Place, decltype(mesh)::Vertex_index> vertices;
  const auto vertex = [&](const Place& p, const Place& sign) {
    const Place place = {p[0] * sign[0], p[1] * sign[1], p[2] * sign[2]};
    const auto found = vertices.find(place);
    if (found != vertices.end())
      return found->second;
    const auto height = [&](int i) { return std::sin(std::acos(0) * i / n); }; // so that edges are about as long
    const double x = height(p[0]), y = height(p[1]), z = height(p[2]), length = std::hypot(x, y, z);
    return vertices[place] = mesh.add_vertex(Point(sign[0] * x / length, sign[1] * y / length, sign[2] * z / length));
  };
  for (int octant = 0; octant < 8; ++octant) {
    const Place sign = {octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1};
    const auto add = [&](const Place& a, const Place& b, const Place& c) {
      const bool is_turned = sign[0] * sign[1] * sign[2] < 0;
      mesh.add_face(vertex(a, sign), vertex(is_turned ? c : b, sign), vertex(is_turned ? b : c, sign));
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        const int k = n - 1 - i - j;
        add({i + 1, j, k}, {i, j + 1, k}, {i, j, k + 1});
        if (k > 0)
          add({i, j + 1, k}, {i + 1, j, k}, {i + 1, j + 1, k - 1});
      }
  }
  examples::write_mesh(path, mesh);
}

} // namespace haptic_sculpt::window_program
