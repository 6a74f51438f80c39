// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/generated_meshes.h"

#include <haptic_sculpt/collision.h>
#include <haptic_sculpt/surface/broad_phase/Brute_force_broad_phase.h>
#include <haptic_sculpt/surface/broad_phase/Swept_star_3.h>

#include <algorithm>
#include <array>
#include <vector>

namespace broad_phase_tests {

using namespace haptic_sculpt;
using Mesh = meshes::Mesh;
using Kernel = meshes::Kernel;
using Point_3 = meshes::Point_3;
using Vertex_index = Mesh::Vertex_index;
using Face_index = Mesh::Face_index;
using Halfedge_index = Mesh::Halfedge_index;
using Coordinates = std::array<double, 3>;

inline std::vector<Face_index> sorted(std::vector<Face_index> faces) {
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// Exactly whether the tetrahedron stgi, degenerate or not, meets the triangle: a corner of what they share is a corner
/// of the triangle in the tetrahedron, or lies on an edge of one and a face of the other. Where the sweeps do not take
/// a degenerate feature, others see what it meets; only a triangle that is a point on a tetrahedron with g == i is
/// overlooked.
inline bool do_meet(const Coordinates& s, const Coordinates& t, const Coordinates& g, const Coordinates& i,
                    const std::array<Coordinates, 3>& triangle) {
  const Swept_collision_traits_3<Kernel> traits;
  const auto vertex_face = traits.vertex_face_sweep_3_object();
  const auto edge_edge = traits.edge_edge_sweep_3_object();
  const auto face_vertex = traits.face_vertex_sweep_3_object();
  const auto point = [](const Coordinates& p) { return Point_3(p[0], p[1], p[2]); };
  const std::array<Point_3, 3> a = {point(triangle[0]), point(triangle[1]), point(triangle[2])};
  const std::array<Point_3, 4> tet = {point(s), point(t), point(g), point(i)};
  const bool is_flat = CGAL::collinear(a[0], a[1], a[2]);
  for (int k = 0; k < 3; ++k)
    if (tet[2] != tet[3] && face_vertex.do_collide(tet[0], tet[1], tet[2], tet[3], a[k]))
      return true;
  for (int j = 0; j < 4; ++j)
    for (int k = j + 1; k < 4; ++k)
      if (!is_flat && vertex_face.do_collide(tet[j], tet[k], a[0], a[1], a[2]))
        return true;
  for (int j = 0; j < 4; ++j)
    for (int k = 0; k < 3; ++k)
      if (a[k] != a[(k + 1) % 3] &&
          edge_edge.do_collide(tet[(j + 1) % 4], tet[(j + 2) % 4], tet[(j + 3) % 4], a[k], a[(k + 1) % 3]))
        return true;
  return false;
}

inline std::array<Coordinates, 3> corners(const Mesh& mesh, Face_index f) {
  const auto h = mesh.halfedge(f);
  return {vertex_coordinates(mesh, mesh.source(h)), vertex_coordinates(mesh, mesh.target(h)),
          vertex_coordinates(mesh, mesh.target(mesh.next(h)))};
}

/// The faces that the star sweeps over, exactly; only those whose box meets the star's can be among them.
inline std::vector<Face_index> swept_faces(const Mesh& mesh, const Swept_star_3& star) {
  std::vector<Face_index> near, swept;
  Brute_force_broad_phase<Mesh>(mesh).query(star.box(), near);
  for (const Face_index f : near) {
    const auto triangle = corners(mesh, f);
    bool meets = star.valence == 0 && do_meet(star.source, star.target, star.target, star.target, triangle);
    for (std::size_t i = 0; i < star.valence && !meets; ++i)
      meets = do_meet(star.source, star.target, star.link[i], star.link[(i + 1) % star.valence], triangle);
    if (meets)
      swept.push_back(f);
  }
  return swept;
}

} // namespace broad_phase_tests
