// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sculpting/Mesh_snapshot.h"
#include "sculpting/Random_scene.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace haptic_sculpt::test {

using Names = std::array<std::size_t, 3>;

/// All values of the four kinds of elements by numbers of vertices; those of halfedges by source and target.
template <class Sculptor, class Get>
std::map<std::pair<int, Names>, int> all_values(const Sculptor& sculptor, const Get& value_of) {
  const Mesh& mesh = sculptor.mesh();
  const auto name = [&](Vertex_index v) { return sculptor.id(v); };
  std::map<std::pair<int, Names>, int> values;
  for (const auto v : mesh.vertices())
    values[{0, {name(v), 0, 0}}] = value_of(v);
  for (const auto h : mesh.halfedges())
    values[{1, {name(mesh.source(h)), name(mesh.target(h)), 0}}] = value_of(h);
  for (const auto e : mesh.edges()) {
    const auto ends = std::minmax({name(mesh.vertex(e, 0)), name(mesh.vertex(e, 1))});
    values[{2, {ends.first, ends.second, 0}}] = value_of(e);
  }
  for (const auto f : mesh.faces()) {
    Names corners{};
    std::size_t i = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      corners[i++] = name(v);
    std::sort(corners.begin(), corners.end());
    values[{3, corners}] = value_of(f);
  }
  return values;
}

/// A mesh with a map of int for each kind, all values different.
struct Numbered_mesh {
  Mesh mesh;
  Mesh::Property_map<Mesh::Vertex_index, int> of_vertices;
  Mesh::Property_map<Mesh::Halfedge_index, int> of_halfedges;
  Mesh::Property_map<Mesh::Edge_index, int> of_edges;
  Mesh::Property_map<Mesh::Face_index, int> of_faces;
  int next = 1;

  explicit Numbered_mesh(const meshes::Triangle_list& list) : mesh(meshes::to_mesh(list)) {
    of_vertices = mesh.add_property_map<Mesh::Vertex_index, int>("v:number", 0).first;
    of_halfedges = mesh.add_property_map<Mesh::Halfedge_index, int>("h:number", 0).first;
    of_edges = mesh.add_property_map<Mesh::Edge_index, int>("e:number", 0).first;
    of_faces = mesh.add_property_map<Mesh::Face_index, int>("f:number", 0).first;
    renumber();
  }
  void renumber() {
    for (const auto v : mesh.vertices())
      of_vertices[v] = next++;
    for (const auto h : mesh.halfedges())
      of_halfedges[h] = next++;
    for (const auto e : mesh.edges())
      of_edges[e] = next++;
    for (const auto f : mesh.faces())
      of_faces[f] = next++;
  }
  template <class Sculptor>
  void keep_all(Sculptor& sculptor) const {
    sculptor.keep(of_vertices);
    sculptor.keep(of_halfedges);
    sculptor.keep(of_edges);
    sculptor.keep(of_faces);
  }
  int operator()(Mesh::Vertex_index v) const { return of_vertices[v]; }
  int operator()(Mesh::Halfedge_index h) const { return of_halfedges[h]; }
  int operator()(Mesh::Edge_index e) const { return of_edges[e]; }
  int operator()(Mesh::Face_index f) const { return of_faces[f]; }
};

/// For edits by hand, and at random.
inline meshes::Triangle_list lumpy_ball() {
  return meshes::bumpy_sphere(1, 0.1, 0.05);
}

} // namespace haptic_sculpt::test
