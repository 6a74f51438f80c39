// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Scene.h"
#include <CGAL/Surface_mesh.h>
#include <CGAL/number_utils.h>

namespace haptic_sculpt::drawing {

/// A CGAL point or vector, rounded to doubles.
template <class Triple>
Eigen::Vector3d to_eigen(const Triple& p) {
  return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
}

/// The scene of a triangle mesh, without marks. Removed elements do not show; a vertex's place in `Scene::points` is
/// its rank among the vertices that are left. O(vertices + faces). \pre all faces are triangles
template <class Point>
Scene scene_of(const CGAL::Surface_mesh<Point>& mesh) {
  Scene scene;
  std::vector<int> rank(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), -1);
  scene.points.reserve(mesh.number_of_vertices());
  for (auto v : mesh.vertices()) {
    rank[std::size_t(v)] = int(scene.points.size());
    scene.points.push_back(to_eigen(mesh.point(v)));
  }
  scene.triangles.reserve(mesh.number_of_faces());
  for (auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    scene.triangles.push_back({rank[std::size_t(mesh.source(h))], rank[std::size_t(mesh.target(h))],
                               rank[std::size_t(mesh.target(mesh.next(h)))]});
  }
  return scene;
}

} // namespace haptic_sculpt::drawing
