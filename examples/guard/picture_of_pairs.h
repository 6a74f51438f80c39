// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "drawing/write_picture.h"
#include "example_meshes.h"

#include <set>

/// Adds a mesh, moved aside, with the faces of self-intersecting pairs in red.
inline void add_to_picture(haptic_sculpt::drawing::Scene& scene, const Mesh& mesh, double aside) {
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(pairs));
  std::set<Mesh::Face_index> red;
  for (const auto& [f, g] : pairs)
    red.insert({f, g});
  for (const auto f : mesh.faces()) {
    std::array<int, 3> corners;
    int i = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
      const auto& p = mesh.point(v);
      corners[i++] = static_cast<int>(scene.points.size());
      scene.points.emplace_back(p.x() + aside, p.y(), p.z());
      scene.point_colors.push_back(red.count(f) != 0 ? haptic_sculpt::drawing::colors::red
                                                     : haptic_sculpt::drawing::colors::surface);
    }
    scene.triangles.push_back(corners);
  }
}
