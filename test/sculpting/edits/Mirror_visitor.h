// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sculpting/Mesh_snapshot.h"
#include "sculpting/Random_scene.h"

#include <map>

namespace haptic_sculpt::test {

/// A copy of a mesh kept by what a visitor hears, and nothing else. Counts what cannot be right: an element that dies
/// without having lived or is not what it was when it was created, or one that is created where one lives.
struct Mirror_visitor : Default_edit_visitor {
  using Face_index = Mesh::Face_index;
  using Edge_index = Mesh::Edge_index;

  struct Vertex {
    std::size_t number;
    std::array<double, 3> point;
  };
  const Mesh* mesh;
  std::map<Vertex_index, Vertex> vertices;
  std::map<Edge_index, std::array<std::size_t, 2>> edges;
  std::map<Face_index, std::array<std::size_t, 3>> faces;
  std::size_t calls = 0, faults = 0;

  explicit Mirror_visitor(const Mesh& m) : mesh(&m) {
    for (const Vertex_index v : m.vertices())
      vertex_created(v, static_cast<std::size_t>(v));
    for (const Edge_index e : m.edges())
      edge_created(e);
    for (const Face_index f : m.faces())
      face_created(f);
    calls = 0;
  }

  void vertex_moved(Vertex_index v) {
    ++calls;
    faults += vertices.count(v) == 0;
    vertices[v].point = vertex_coordinates(*mesh, v);
  }
  void vertex_dies(Vertex_index v, std::size_t number) {
    ++calls;
    const auto found = vertices.find(v);
    faults += found == vertices.end() || found->second.number != number;
    vertices.erase(v);
  }
  void edge_dies(Edge_index e) { dies(edges, e, corners(e)); }
  void face_dies(Face_index f) { dies(faces, f, corners(f)); }
  void vertex_created(Vertex_index v, std::size_t number) {
    ++calls;
    faults += !vertices.insert({v, {number, vertex_coordinates(*mesh, v)}}).second;
  }
  void edge_created(Edge_index e) { is_created(edges, e, corners(e)); }
  void face_created(Face_index f) { is_created(faces, f, corners(f)); }

  Mesh_snapshot snapshot() const {
    Mesh_snapshot result;
    for (const auto& entry : vertices)
      result.add_point(entry.second.number, entry.second.point);
    for (const auto& entry : faces)
      result.add_face(entry.second);
    result.sort();
    return result;
  }
  /// Whether the edges are those of the mesh, by descriptor and ends.
  bool has_edges_of_mesh() const {
    std::size_t right = 0;
    for (const Edge_index e : mesh->edges()) {
      const auto found = edges.find(e);
      right += found != edges.end() && found->second == corners(e);
    }
    return right == edges.size() && right == mesh->number_of_edges();
  }

private:
  std::size_t number(Vertex_index v) const {
    const auto found = vertices.find(v);
    return found == vertices.end() ? ~std::size_t{0} : found->second.number;
  }
  std::array<std::size_t, 2> corners(Edge_index e) const {
    const std::size_t a = number(mesh->vertex(e, 0)), b = number(mesh->vertex(e, 1));
    return {std::min(a, b), std::max(a, b)};
  }
  std::array<std::size_t, 3> corners(Face_index f) const {
    const auto h = mesh->halfedge(f);
    std::array<std::size_t, 3> c = {number(mesh->source(h)), number(mesh->target(h)),
                                    number(mesh->target(mesh->next(h)))};
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    return c;
  }
  template <class Map, class Index, class Corners>
  void dies(Map& map, Index index, const Corners& now) {
    ++calls;
    const auto found = map.find(index);
    faults += found == map.end() || found->second != now;
    map.erase(index);
  }
  template <class Map, class Index, class Corners>
  void is_created(Map& map, Index index, const Corners& now) {
    ++calls;
    faults += !map.insert({index, now}).second;
  }
};

} // namespace haptic_sculpt::test
