// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "robustness_meshes.h"

#include <haptic_sculpt/sculpting.h>

#include <algorithm>
#include <limits>

namespace haptic_sculpt::robustness {

/// Draws elements of a mesh, targets of drags and places of new vertices, ordinary and degenerate ones.
class Random_places {
public:
  /// The mesh may change between draws.
  Random_places(const Mesh& mesh, std::uint64_t seed) : mesh_(mesh), random_(seed) {}

  std::size_t below(std::size_t n) { return random_() % n; }
  double number() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  /// One with faces.
  Vertex_index vertex() {
    for (;;) {
      const Vertex_index v(static_cast<Mesh::size_type>(below(mesh_.num_vertices())));
      if (!mesh_.is_removed(v))
        return v;
    }
  }
  Halfedge_index halfedge() {
    for (;;) {
      const Halfedge_index h(static_cast<Mesh::size_type>(below(mesh_.num_halfedges())));
      if (!mesh_.is_removed(h))
        return h;
    }
  }
  Vertex_index neighbour(Vertex_index v) {
    auto h = mesh_.halfedge(v);
    for (std::size_t turns = below(8); turns > 0; --turns)
      h = mesh_.opposite(mesh_.next(h));
    return mesh_.source(h);
  }
  Vector_3 direction() {
    for (;;) {
      const double x = 2 * number() - 1, y = 2 * number() - 1, z = 2 * number() - 1, square = x * x + y * y + z * z;
      if (square > 0.01 && square < 1)
        return Vector_3(x, y, z) / std::sqrt(square);
    }
  }
  /// The shortest at v: a step has to suit the star.
  double edge_length(Vertex_index v) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (const auto h : mesh_.halfedges_around_target(mesh_.halfedge(v)))
      shortest = std::min(
          shortest, internal::path_length(vertex_coordinates(mesh_, v), vertex_coordinates(mesh_, mesh_.source(h))));
    return shortest;
  }

  /// \name Targets of a drag of v
  ///@{
  Point_3 short_step(Vertex_index v) { return mesh_.point(v) + 0.1 * edge_length(v) * direction(); }
  Point_3 long_step(Vertex_index v) { return mesh_.point(v) + 5 * edge_length(v) * direction(); }
  /// To the other side of another vertex far away, through what lies between.
  Point_3 through(Vertex_index v) {
    const Point_3 p = mesh_.point(v), q = mesh_.point(vertex());
    return q + 0.5 * (q - p);
  }
  Point_3 on_a_neighbour(Vertex_index v) {
    const Point_3 a = mesh_.point(neighbour(v)), b = mesh_.point(neighbour(neighbour(v)));
    switch (below(3)) {
    case 0: return a;
    case 1: return CGAL::midpoint(a, b);
    default: return CGAL::centroid(a, b, mesh_.point(neighbour(v)));
    }
  }
  Point_3 along_an_axis(Vertex_index v) {
    std::array<double, 3> p = vertex_coordinates(mesh_, v);
    p[below(3)] += (4 * number() - 2) * edge_length(v);
    return {p[0], p[1], p[2]};
  }
  /// Along an edge, both ways: in two planes at once.
  Point_3 in_the_plane_of_a_face(Vertex_index v) {
    const Point_3 p = mesh_.point(v), a = mesh_.point(neighbour(v));
    return p + (4 * number() - 2) * (a - p);
  }
  /// One of the others, at random.
  Point_3 odd_target(Vertex_index v) {
    switch (below(5)) {
    case 0: return long_step(v);
    case 1: return mesh_.point(vertex());
    case 2: return on_a_neighbour(v);
    case 3: return along_an_axis(v);
    default: return in_the_plane_of_a_face(v);
    }
  }
  ///@}

  /// \name Places of a new vertex on the face or edge of h
  /// "Near" is 1e-3 to 1e-17 of the edge, drawn by exponent: below the coordinates' last bits, too.
  ///@{
  Point_3 inside_face(Halfedge_index h) {
    double a = 0.05 + 0.9 * number(), b = 0.05 + 0.9 * number();
    if (a + b > 0.95)
      a = 0.5 * (1 - a), b = 0.5 * (1 - b);
    return in_face(h, a, b);
  }
  Point_3 near_corner(Halfedge_index h) { return in_face(h, near(), near()); }
  /// Of the face or of one beside it.
  Point_3 corner(Halfedge_index h) {
    return mesh_.point(mesh_.target(below(3) == 0 ? mesh_.next(mesh_.opposite(h)) : h));
  }
  Point_3 on_edge(Halfedge_index h) {
    return below(2) == 0 ? CGAL::midpoint(source(h), target(h)) : between(h, 0.05 + 0.9 * number());
  }
  Point_3 near_end(Halfedge_index h) { return between(h, near()); }
  Point_3 end(Halfedge_index h) { return below(2) == 0 ? source(h) : target(h); }
  /// Above or below the face: a creation may pull the surface out at once.
  Point_3 off_face(Halfedge_index h) {
    return inside_face(h) + 0.3 * number() * edge_length(mesh_.target(h)) * direction();
  }
  ///@}

private:
  const Mesh& mesh_;
  std::mt19937_64 random_;

  const Point_3& source(Halfedge_index h) const { return mesh_.point(mesh_.source(h)); }
  const Point_3& target(Halfedge_index h) const { return mesh_.point(mesh_.target(h)); }
  double near() { return std::pow(10, -3 - 14 * number()); }
  Point_3 between(Halfedge_index h, double a) const { return source(h) + a * (target(h) - source(h)); }
  Point_3 in_face(Halfedge_index h, double a, double b) const {
    return source(h) + a * (target(h) - source(h)) + b * (target(mesh_.next(h)) - source(h));
  }
};

} // namespace haptic_sculpt::robustness
