// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "surface/broad_phase/random_points.h"
#include "surface/broad_phase/swept_faces.h"

#include <haptic_sculpt/sculpting/paper_1997/Six_list_broad_phase.h>
#include <haptic_sculpt/surface/broad_phase/Box_tree_broad_phase.h>
#include <haptic_sculpt/surface/connectivity/star.h>

#include <CGAL/boost/graph/Euler_operations.h>

namespace broad_phase_tests {

/// Where a scene lies: x -> offset + scale * x.
struct Frame {
  double scale, offset;
  Coordinates operator()(const Coordinates& p) const {
    return {offset + scale * p[0], offset + scale * p[1], offset + scale * p[2]};
  }
};

/// A mesh that changes, and broad phases that hear of it.
struct Changing_mesh {
  Mesh mesh;
  Frame frame;
  Brute_force_broad_phase<Mesh> brute_force{mesh};
  Six_list_broad_phase<Mesh> six_lists{mesh};
  Box_tree_broad_phase<Mesh> tree{mesh};
  std::size_t inserted = 0, removed = 0;

  Changing_mesh(const Mesh& m, const Frame& f) : mesh(m), frame(f) {
    for (const Vertex_index v : mesh.vertices())
      set_point(v, vertex_coordinates(mesh, v));
    std::vector<Face_index> all(mesh.faces().begin(), mesh.faces().end());
    moved(all);
  }

  void set_point(Vertex_index v, const Coordinates& p) {
    const Coordinates q = frame(p);
    mesh.point(v) = Point_3(q[0], q[1], q[2]);
  }
  template <class Faces>
  void moved(const Faces& faces) {
    six_lists.faces_moved(faces), tree.faces_moved(faces);
  }
  template <class Faces>
  void came(const Faces& faces) {
    six_lists.faces_inserted(faces), tree.faces_inserted(faces);
    inserted += faces.size();
  }
  template <class Faces>
  void went(const Faces& faces) {
    six_lists.faces_removed(faces), tree.faces_removed(faces);
    removed += faces.size();
  }

  std::vector<Face_index> faces_around(Vertex_index v) const {
    std::vector<Face_index> faces;
    if (!mesh.is_isolated(v))
      for (const Face_index f : mesh.faces_around_target(mesh.halfedge(v)))
        if (f != Mesh::null_face())
          faces.push_back(f);
    return faces;
  }
  Vertex_index random_vertex(Random& random) const {
    for (;;) {
      const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
      if (!mesh.is_removed(v))
        return v;
    }
  }

  void move_a_vertex(Random& random) {
    const Vertex_index v = random_vertex(random);
    if (random() % 4 == 0) // onto another: degenerate faces, flat boxes
      mesh.point(v) = mesh.point(random_vertex(random));
    else
      set_point(v, random_point(random, 1.5));
    moved(faces_around(v));
  }
  void insert_a_vertex(Random& random) {
    const Vertex_index v = random_vertex(random);
    const Face_index f = mesh.face(mesh.halfedge(v));
    const std::array<Coordinates, 3> c = corners(mesh, f);
    const Halfedge_index h = CGAL::Euler::add_center_vertex(mesh.halfedge(f), mesh);
    mesh.point(mesh.target(h)) = Point_3(c[0][0] / 2 + c[1][0] / 2, c[1][1], c[2][2]);
    std::vector<Face_index> fresh = faces_around(mesh.target(h));
    fresh.erase(std::find(fresh.begin(), fresh.end(), f));
    moved(std::vector<Face_index>{f});
    came(fresh);
  }
  void collapse_an_edge(Random& random, bool told_before) {
    const Vertex_index v = random_vertex(random);
    const auto h = mesh.halfedge(v);
    const auto e = mesh.edge(h);
    if (mesh.number_of_faces() <= 8 || !CGAL::Euler::does_satisfy_link_condition(e, mesh))
      return;
    const std::vector<Face_index> gone = {mesh.face(h), mesh.face(mesh.opposite(h))};
    if (told_before)
      went(gone);
    const Vertex_index kept = CGAL::Euler::collapse_edge(e, mesh);
    if (!told_before)
      went(gone);
    moved(faces_around(kept));
  }
  void change(Random& random, unsigned growth) {
    const unsigned dice = random() % 8;
    if (dice < 3)
      move_a_vertex(random);
    else if (dice < 3 + growth)
      insert_a_vertex(random);
    else
      collapse_an_edge(random, random() % 2 == 0);
  }
};

} // namespace broad_phase_tests
