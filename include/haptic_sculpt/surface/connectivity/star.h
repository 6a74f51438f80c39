// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/broad_phase/Swept_star_3.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <vector>

namespace haptic_sculpt::internal {

/// The closed star of a vertex: its link in order around it, and its faces.
///
/// Face i has corners `centre`, `link[i + 1]`, `link[i]` in the orientation of the mesh (indices modulo the valence).
/// Made to be filled again and again: `collect()` allocates only when a valence is larger than any before.
template <class Mesh>
struct Star {
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;
  using Coordinates = std::array<double, 3>;

  Vertex_index centre;
  std::vector<Vertex_index> link;
  std::vector<Coordinates> link_points;
  std::vector<Face_index> faces;

  std::size_t valence() const { return link.size(); }
  std::size_t next(std::size_t i) const { return i + 1 < link.size() ? i + 1 : 0; }

  /// Makes room for a valence, so that collect() allocates nothing for one.
  void reserve(std::size_t valence) {
    link.reserve(valence);
    link_points.reserve(valence);
    faces.reserve(valence);
  }

  /// A star without faces: a probe.
  void clear() {
    link.clear();
    link_points.clear();
    faces.clear();
  }

  /// \pre v is not on a boundary and no face corner is pinched at v. Cost: the valence.
  void collect(const Mesh& mesh, Vertex_index v) {
    collect(mesh, v, [](Vertex_index) {});
  }

  /// Calls `is_known(w)` for each vertex w of the link as soon as it is known: to ask for memory ahead.
  template <class Is_known>
  void collect(const Mesh& mesh, Vertex_index v, const Is_known& is_known) {
    clear();
    centre = v;
    if (mesh.is_isolated(v))
      return;
    const auto first = mesh.halfedge(v);
    auto h = first;
    do {
      link.push_back(mesh.source(h));
      link_points.push_back(vertex_coordinates(mesh, mesh.source(h)));
      faces.push_back(mesh.face(h));
      h = mesh.opposite(mesh.next(h));
      is_known(link.back());
    } while (h != first);
  }

  /// The half-edge from link[i] to the centre, a side of faces[i]. Constant time, where Surface_mesh::halfedge() goes
  /// round the centre.
  typename Mesh::Halfedge_index spoke(const Mesh& mesh, std::size_t i) const {
    auto h = mesh.halfedge(faces[i]);
    while (mesh.target(h) != centre)
      h = mesh.next(h);
    return h;
  }

  Swept_star_3 swept(const Coordinates& source, const Coordinates& target) const {
    return {source, target, link_points.data(), link_points.size()};
  }
};

} // namespace haptic_sculpt::internal
