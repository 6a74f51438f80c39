// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Euler operations that make and unmake a star. Connectivity only: nothing is proven here.

#include <CGAL/boost/graph/Euler_operations.h>

#include <vector>

namespace haptic_sculpt::internal {

/// The halfedge of h's face that ends in v. \pre there is one
template <class Mesh>
typename Mesh::Halfedge_index halfedge_of_face_to(const Mesh& mesh, typename Mesh::Halfedge_index h,
                                                  typename Mesh::Vertex_index v) {
  while (mesh.target(h) != v)
    h = mesh.next(h);
  return h;
}

/// Replaces the triangle (or polygon) f by the star of a new vertex. Face f dies or becomes one of the new ones.
template <class Mesh>
typename Mesh::Vertex_index insert_star_in_face(Mesh& mesh, typename Mesh::Halfedge_index h_of_face,
                                                const typename Mesh::Point& p) {
  const auto v = mesh.target(CGAL::Euler::add_center_vertex(h_of_face, mesh));
  mesh.point(v) = p;
  return v;
}

/// Replaces the two triangles at h by the four of a new vertex between the ends of h.
template <class Mesh>
typename Mesh::Vertex_index insert_star_in_edge(Mesh& mesh, typename Mesh::Halfedge_index h,
                                                const typename Mesh::Point& p) {
  const auto into = CGAL::Euler::split_edge(h, mesh);
  const auto v = mesh.target(into);
  mesh.point(v) = p;
  const auto across = mesh.opposite(mesh.next(into));
  CGAL::Euler::split_face(into, mesh.next(mesh.next(into)), mesh);
  CGAL::Euler::split_face(across, mesh.next(mesh.next(across)), mesh);
  return v;
}

/// Removes v and its star. Returns a halfedge of the polygon that is left.
template <class Mesh>
typename Mesh::Halfedge_index remove_star(Mesh& mesh, typename Mesh::Vertex_index v) {
  return CGAL::Euler::remove_center_vertex(mesh.halfedge(v), mesh);
}

/// A fan is given by the halfedges into its apex, one in each of its faces: the first on the polygon around the fan,
/// the others within.
template <class Mesh>
using Fan = std::vector<typename Mesh::Halfedge_index>;

/// Fills the polygon of h with the fan of `apex`. Cost: the size of the polygon.
template <class Mesh>
void fill_with_fan(Mesh& mesh, typename Mesh::Halfedge_index h, typename Mesh::Vertex_index apex, Fan<Mesh>& fan) {
  const auto into_apex = halfedge_of_face_to(mesh, h, apex);
  fan.assign(1, into_apex);
  while (mesh.next(mesh.next(mesh.next(into_apex))) != into_apex) {
    const auto second = mesh.next(mesh.next(into_apex));
    CGAL::Euler::split_face(into_apex, second, mesh); // cuts off the triangle of `second`
    fan.push_back(mesh.next(second));
  }
}

/// Finds the fan of this many faces that begins with the halfedge `first` into its apex, in the order of Star::link,
/// which runs against the orientation of the faces. Cost: its size.
template <class Mesh>
void find_fan(const Mesh& mesh, typename Mesh::Halfedge_index first, std::size_t faces, Fan<Mesh>& fan) {
  fan.assign(1, first);
  while (fan.size() < faces)
    fan.push_back(mesh.opposite(mesh.next(fan.back())));
}

/// Makes one face of a fan. Undoes fill_with_fan(). Cost: the size of the fan.
template <class Mesh>
typename Mesh::Halfedge_index merge_fan(Mesh& mesh, const Fan<Mesh>& fan) {
  for (std::size_t i = 1; i < fan.size(); ++i)
    CGAL::Euler::join_face(mesh.opposite(fan[i]),
                           mesh); // the triangle of fan[i] goes; the other way the loop would be walked again and again
  return fan[0];
}

} // namespace haptic_sculpt::internal
