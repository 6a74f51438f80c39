// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace haptic_sculpt {

/// Corners of a polygon, by their place in it.
using Corners_of_triangle = std::array<std::size_t, 3>;

namespace internal::polygons {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Seen_polygon = std::vector<Kernel::Point_2>;

/// The three directions of the axes, that which looks at most of the polygon first. It is a choice only: rounded.
inline std::array<int, 3> axes_by_area(const std::vector<std::array<double, 3>>& corners) {
  double largest = 0; // by which all is divided: areas do not overflow then
  for (const auto& p : corners)
    for (const double x : p)
      largest = std::fmax(largest, std::fabs(x));
  std::array<double, 3> area{};
  const auto at = [&](std::size_t i, int axis) {
    return corners[i % corners.size()][axis] / largest - corners[0][axis] / largest;
  };
  for (std::size_t i = 0; i < corners.size() && largest > 0; ++i)
    for (int k = 0; k < 3; ++k) {
      const int x = (k + 1) % 3, y = (k + 2) % 3;
      area[k] += at(i, x) * at(i + 1, y) - at(i + 1, x) * at(i, y);
    }
  std::array<int, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return std::fabs(area[a]) > std::fabs(area[b]); });
  return axes;
}

/// The inside of a simple polygon, divided by edges between its corners (constrained Delaunay).
inline std::vector<Corners_of_triangle> triangles_inside(const Seen_polygon& polygon) {
  using Vertex_base = CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Kernel>;
  using Face_with_side = CGAL::Triangulation_face_base_with_info_2<int, Kernel>;
  using Face_base = CGAL::Constrained_triangulation_face_base_2<Kernel, Face_with_side>;
  using Structure = CGAL::Triangulation_data_structure_2<Vertex_base, Face_base>;
  // No two of its edges cross: that a constraint would be cut is never asked for.
  using No_crossings = CGAL::No_constraint_intersection_tag;
  using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, No_crossings>;
  std::vector<std::pair<Kernel::Point_2, std::size_t>> corners;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    corners.emplace_back(polygon[i], i);
  Triangulation triangulation;
  triangulation.insert(corners.begin(), corners.end()); // in an order of space, which takes n log n
  std::vector<Triangulation::Vertex_handle> vertices(polygon.size());
  for (const auto v : triangulation.finite_vertex_handles())
    vertices[v->info()] = v;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    triangulation.insert_constraint(vertices[i], vertices[(i + 1) % vertices.size()]);
  enum Side { unknown, outside, inside };
  for (const auto f : triangulation.all_face_handles())
    f->info() = unknown;
  std::vector<Triangulation::Face_handle> waiting{triangulation.infinite_face()};
  waiting[0]->info() = outside;
  std::vector<Corners_of_triangle> triangles;
  while (!waiting.empty()) {
    const auto f = waiting.back();
    waiting.pop_back();
    if (f->info() == inside)
      triangles.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
    for (int i = 0; i < 3; ++i) {
      const auto next = f->neighbor(i);
      if (next->info() != unknown)
        continue;
      next->info() = triangulation.is_constrained({f, i}) ? (f->info() == outside ? inside : outside) : f->info();
      waiting.push_back(next);
    }
  }
  return triangles;
}

} // namespace internal::polygons

/// Divides a polygon in space into triangles between its corners, in its orientation. It is looked at along one of the
/// axes, which rounds nothing, and proven to be simple as it is seen then. (CGAL's `triangulate_face()` projects along
/// a normal that is rounded, and on some polygons that cross themselves it never ends.)
/// \param corners three at least, finite
/// \return n - 2 triangles; nothing where it is simple along none of the axes. Cost: n log n in general
inline std::optional<std::vector<Corners_of_triangle>>
divided_polygon(const std::vector<std::array<double, 3>>& corners) {
  namespace polygons = internal::polygons;
  const internal::Rounding_to_nearest rounding;
  for (const int axis : polygons::axes_by_area(corners)) {
    polygons::Seen_polygon seen;
    for (const auto& p : corners)
      seen.emplace_back(p[(axis + 1) % 3], p[(axis + 2) % 3]);
    if (!CGAL::is_simple_2(seen.begin(), seen.end(), polygons::Kernel()))
      continue;
    std::vector<Corners_of_triangle> triangles = polygons::triangles_inside(seen);
    if (CGAL::orientation_2(seen.begin(), seen.end(), polygons::Kernel()) == CGAL::CLOCKWISE)
      for (Corners_of_triangle& t : triangles)
        std::swap(t[1], t[2]);
    return triangles;
  }
  return std::nullopt;
}

} // namespace haptic_sculpt
