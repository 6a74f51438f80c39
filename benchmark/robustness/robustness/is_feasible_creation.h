// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oracle/exact_triangles.h"
#include "robustness_meshes.h"

#include <haptic_sculpt/surface/broad_phase/face_box.h>

#include <map>

namespace haptic_sculpt::robustness {

/// Whether a vertex can be created at p in place of the faces of `old_halfedges` (one, or both of an edge): the mesh is
/// embedded afterwards, and no vertex lies in a closed tetrahedron between an old face and p, so that nothing has been
/// jumped over.
///
/// Decided over integers from the definition, with nothing of the library's predicates and broad phases. Cost: linear
/// in the mesh, and slow near p; meant for what was refused.
inline bool is_feasible_creation(const Mesh& mesh, const std::vector<Halfedge_index>& old_halfedges, const Point_3& p) {
  oracle::Mesh_list list;
  list.points.push_back({p.x(), p.y(), p.z()});
  std::map<Vertex_index, int> index;
  const auto corner = [&](Vertex_index v) {
    const auto [place, is_new] = index.emplace(v, static_cast<int>(list.points.size()));
    if (is_new)
      list.points.push_back(vertex_coordinates(mesh, v));
    return place->second;
  };
  const auto corners = [&](Halfedge_index h) {
    return oracle::Corner_indices{corner(mesh.source(h)), corner(mesh.target(h)), corner(mesh.target(mesh.next(h)))};
  };
  std::vector<oracle::Corner_indices> old_faces, new_faces, others;
  Box_3 box(list.points[0]);
  for (const Halfedge_index h : old_halfedges) {
    const oracle::Corner_indices old = corners(h);
    old_faces.push_back(old);
    for (int i = old_halfedges.size() == 1 ? 0 : 1; i < 3; ++i)
      new_faces.push_back({0, old[i], old[(i + 1) % 3]});
    box.include(face_box(mesh, mesh.face(h)));
  }
  for (const Face_index f : mesh.faces()) {
    bool is_old = false;
    for (const Halfedge_index h : old_halfedges)
      is_old |= mesh.face(h) == f;
    if (!is_old && do_meet(face_box(mesh, f), box))
      others.push_back(corners(mesh.halfedge(f)));
  }
  const auto points = oracle::scaled_to_integers(list.points);
  const oracle::Still_signs<mpz_class> signs{points};
  for (std::size_t i = 0; i < new_faces.size(); ++i) {
    const auto& f = new_faces[i];
    if (oracle::on_one_line(signs, f[0], f[1], f[2]))
      return false;
    for (std::size_t j = 0; j < i; ++j)
      if (oracle::triangles_meet_improperly(signs, f, new_faces[j]))
        return false;
    for (const auto& g : others)
      if (oracle::triangles_meet_improperly(signs, f, g))
        return false;
  }
  for (const auto& old : old_faces)
    for (std::size_t v = 1; v < points.size(); ++v) {
      const int q = static_cast<int>(v);
      if (q == old[0] || q == old[1] || q == old[2])
        continue;
      // In a tetrahedron of volume no face of which has it on the far side. A flat one is made of old and new faces,
      // tested above.
      const int side = signs.orient_3(old[0], old[1], old[2], 0);
      if (side != 0 && signs.orient_3(q, old[1], old[2], 0) * side >= 0 &&
          signs.orient_3(old[0], q, old[2], 0) * side >= 0 && signs.orient_3(old[0], old[1], q, 0) * side >= 0 &&
          signs.orient_3(old[0], old[1], old[2], q) * side >= 0)
        return false;
    }
  return true;
}

} // namespace haptic_sculpt::robustness
