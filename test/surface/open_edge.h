// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace haptic_sculpt::test {

/// Opens a mesh along the edge of a half-edge: the face beside it gets an edge of its own between the same two
/// vertices, and a hole of two edges is between the faces. \return the new half-edge of that face
template <class Mesh>
typename Mesh::Halfedge_index open_edge(Mesh& mesh, typename Mesh::Halfedge_index h) {
  const auto face = mesh.face(h), none = Mesh::null_face();
  const auto before = mesh.prev(h), after = mesh.next(h);
  const auto own = mesh.add_edge(), beyond = mesh.opposite(own);
  mesh.set_target(own, mesh.target(h)), mesh.set_target(beyond, mesh.source(h));
  mesh.set_next(before, own), mesh.set_next(own, after);
  mesh.set_face(own, face), mesh.set_halfedge(face, own);
  mesh.set_next(h, beyond), mesh.set_next(beyond, h);
  mesh.set_face(h, none), mesh.set_face(beyond, none);
  mesh.set_halfedge(mesh.target(own), h), mesh.set_halfedge(mesh.source(own), beyond);
  return own;
}

} // namespace haptic_sculpt::test
