// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/brushes/scaled_directions.h>
#include <haptic_sculpt/surface/Aabb_traits.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <vector>

namespace haptic_sculpt::drawing {

/// How light each vertex is, by index, from 0.35 (in a crevice) to 1: the share of directions in which nothing is near
/// ("ambient occlusion"). O(vertices log faces).
template <class Point>
std::vector<float> openness(const CGAL::Surface_mesh<Point>& mesh) {
  using Mesh = CGAL::Surface_mesh<Point>;
  using Kernel = typename CGAL::Kernel_traits<Point>::Kernel;
  using Vector = typename Kernel::Vector_3;
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
  constexpr int directions = 48;
  constexpr double reach = 0.15;  // of the diagonal: what is farther darkens nothing
  constexpr double lift = 1e-4;   // of the diagonal: the vertex's own faces are not in the way
  const auto box = CGAL::Polygon_mesh_processing::bbox(mesh);
  const double diagonal =
      std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());

  std::vector<typename Mesh::Face_index> faces;
  for (const auto f : mesh.faces())
    if (!CGAL::Polygon_mesh_processing::is_degenerate_triangle_face(f, mesh))
      faces.push_back(f);
  CGAL::AABB_tree<Aabb_traits<Kernel, Primitive>> tree(faces.begin(), faces.end(), mesh);

  std::vector<float> result(mesh.num_vertices(), 1);
  for (const auto v : mesh.vertices()) {
    if (mesh.is_isolated(v))
      continue;
    const Vector normal = vertex_normal(mesh, v);
    double open = 0, all = 0;
    for (int i = 0; i < directions; ++i) { // spread evenly over the sphere, on a spiral by the golden angle
      const double z = 1 - (2 * i + 1.) / directions, angle = 2.399963229728653 * i, r = std::sqrt(1 - z * z);
      const Vector d(r * std::cos(angle), r * std::sin(angle), z);
      const double weight = d * normal;
      if (weight <= 0.05)
        continue;
      all += weight;
      const Point from = mesh.point(v) + lift * diagonal * (normal + d);
      if (!tree.do_intersect(typename Kernel::Segment_3(from, from + reach * diagonal * d)))
        open += weight;
    }
    result[v] = static_cast<float>(all > 0 ? 0.35 + 0.65 * open / all : 1);
  }
  return result;
}

} // namespace haptic_sculpt::drawing
