// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// What the examples work on, made on the spot, and how they look at it.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// A grid of quadrangles closed to a torus, at the points `at(i, j)`, split into triangles.
template <class Place>
Mesh closed_grid(std::size_t m, std::size_t n, const Place& at) {
  Mesh mesh;
  std::vector<Mesh::Vertex_index> v;
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < n; ++j)
      v.push_back(mesh.add_vertex(at(i, j)));
  const auto index = [&](std::size_t i, std::size_t j) { return v[i % m * n + j % n]; };
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      mesh.add_face(index(i, j), index(i + 1, j), index(i + 1, j + 1));
      mesh.add_face(index(i, j), index(i + 1, j + 1), index(i, j + 1));
    }
  return mesh;
}

/// A torus of radii 1 and `tube`, its cross section flattened to `flatness`, its triangles twisted.
inline Mesh torus(std::size_t m, std::size_t n, double tube, double flatness = 1) {
  return closed_grid(m, n, [=](std::size_t i, std::size_t j) {
    const double u = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(m),
                 v = 6.283185307179586 * static_cast<double>(j) / static_cast<double>(n) + 0.3 * std::sin(5 * u);
    const double r = 1 + tube * std::cos(v);
    return Kernel::Point_3(r * std::cos(u), r * std::sin(u), flatness * tube * std::sin(v) + 0.2 * std::sin(3 * u));
  });
}

/// A fine ring in a coarse one, which comes nearer to it when it is made smooth.
inline Mesh nested_rings(std::size_t m, std::size_t n, double inner_tube) {
  Mesh mesh = torus(m, n, 0.4);
  mesh += torus(96, 24, inner_tube);
  return mesh;
}

inline std::size_t self_intersecting_pairs(const Mesh& mesh) {
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(pairs));
  return pairs.size();
}
