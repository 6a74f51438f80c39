// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// All that stands still while one vertex of a mesh is dragged: whether a straight motion of the vertex is free, and
/// which facets are near it. Without broad phase, checklists or contacts of the response.

#include "oracle/sweep_oracle.h"

#include <haptic_sculpt/collision.h>

#include <CGAL/Surface_mesh.h>

#include <array>
#include <cmath>
#include <vector>

namespace haptic_sculpt::test {

/// Part of a plane that the moving vertex, taken as a point, may not cross.
struct Facet_near {
  char kind;                             ///< 'f' vertex-face, 'e' edge-edge, 'v' face-vertex
  std::array<std::size_t, 3> vertices;   ///< A, B, C; V, A, B; or G, I, A
  std::array<long double, 3> normal;     ///< of length 1, towards the vertex
  long double height;                    ///< >= 0
};

template <class K>
class Still_surroundings {
public:
  using Point_3 = typename K::Point_3;
  using Mesh = CGAL::Surface_mesh<Point_3>;
  using Vertex_index = typename Mesh::Vertex_index;

  /// \param v what moves; null, or without faces: a probe
  Still_surroundings(const Mesh& mesh, Vertex_index v) {
    points_.resize(mesh.num_vertices()); // removed ones too: indices stay
    for (const Vertex_index w : mesh.vertices())
      points_[w] = mesh.point(w);
    if (v.is_valid() && !mesh.is_isolated(v)) {
      const auto first = mesh.halfedge(v);
      auto h = first;
      do {
        link_.push_back(mesh.source(h));
        h = mesh.opposite(mesh.next(h));
      } while (h != first);
    }
    for (const auto f : mesh.faces()) {
      const auto h = mesh.halfedge(f);
      const std::array<std::size_t, 3> corners = {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
      if (corners[0] != v && corners[1] != v && corners[2] != v)
        faces_.push_back({box_of(corners), corners});
    }
    for (const auto e : mesh.edges()) {
      const std::array<std::size_t, 2> ends = {mesh.source(mesh.halfedge(e)), mesh.target(mesh.halfedge(e))};
      if (ends[0] != v && ends[1] != v)
        edges_.push_back({box_of(ends), ends});
    }
    for (const Vertex_index w : mesh.vertices())
      if (w != v)
        vertices_.push_back(w);
  }

  /// Whether the closed way from s to t meets nothing, by the three sweeps of all pairs. \pre s != t
  bool is_free(const Point_3& s, const Point_3& t) const {
    const Swept_collision_traits_3<K> traits;
    const auto vertex_face = traits.vertex_face_sweep_3_object();
    const auto edge_edge = traits.edge_edge_sweep_3_object();
    const auto face_vertex = traits.face_vertex_sweep_3_object();
    return visit_pairs(s, t, [&](Sweep_kind kind, const Point_3& a, const Point_3& b, const Point_3& c) {
      switch (kind) {
      case Sweep_kind::vertex_face: return !vertex_face.do_collide(s, t, a, b, c);
      case Sweep_kind::edge_edge: return !edge_edge.do_collide(s, t, a, b, c);
      default: return !face_vertex.do_collide(s, t, a, b, c);
      }
    });
  }

  /// The same by the oracle of the sweeps: linear feasibility over the integers.
  bool is_free_by_oracle(const Point_3& s, const Point_3& t) const {
    return visit_pairs(s, t, [&](Sweep_kind kind, const Point_3& a, const Point_3& b, const Point_3& c) {
      const Sweep_coordinates x = {s.x(), s.y(), s.z(), t.x(), t.y(), t.z(), a.x(), a.y(),
                                   a.z(), b.x(), b.y(), b.z(), c.x(), c.y(), c.z()};
      return !first_meeting(kind, x).has_value();
    });
  }

  /// The facets whose plane is at most `reach` from x and that x, seen along the normal, is at most about `reach` out
  /// of. Floating point, 64 bits of mantissa: it proposes motions that is_free() then decides.
  std::vector<Facet_near> facets_near(const Point_3& x, double reach) const {
    std::vector<Facet_near> found;
    const auto add = [&](char kind, const std::array<std::size_t, 3>& corners) {
      const Vector a = minus(points_[corners[0]], x), b = minus(points_[corners[1]], x),
                   c = minus(points_[corners[2]], x);
      // Where x meets the plane: as a + s (b - a) + t (c - a).
      const Vector ab = minus(b, a), ac = minus(c, a);
      Vector n = cross(ab, ac);
      const long double area = length(n);
      if (area == 0)
        return;
      for (long double& k : n)
        k /= area;
      long double height = -dot(n, a);
      if (std::abs(height) > reach)
        return;
      const long double s = -dot(cross(a, ac), n) / area, t = -dot(cross(ab, a), n) / area;
      const long double slack = reach / std::fmin(length(ab), length(ac)) * 4;
      bool inside = false;
      switch (kind) {
      case 'f':
        inside = s >= -slack && t >= -slack && s + t <= 1 + slack;
        break;
      case 'e':
        inside = s >= -slack && t >= -slack && s + t >= 1 - slack;
        break; // V, A, B
      default: // G, I, A: x = A + (s + t - 1) (A - G) - s (A - I)
        inside = -s >= -slack && s + t - 1 >= -slack;
      }
      if (!inside)
        return;
      if (height < 0) {
        height = -height;
        for (long double& k : n)
          k = -k;
      }
      found.push_back({kind, corners, n, height});
    };
    for (const Face& f : faces_)
      if (meets(f.box, widened(Box(x), reach)))
        add('f', f.corners);
    for (std::size_t i = 0; i < link_.size(); ++i) {
      const Box box = widened(Box(x).include(points_[link_[i]]), reach);
      for (const Edge& e : edges_)
        if (e.ends[0] != link_[i] && e.ends[1] != link_[i] && meets(e.box, box))
          add('e', {link_[i], e.ends[0], e.ends[1]});
      const std::size_t g = link_[i], k = link_[(i + 1) % link_.size()];
      const Box swept = widened(Box(x).include(points_[g]).include(points_[k]), reach);
      for (const std::size_t a : vertices_)
        if (a != g && a != k && meets(Box(points_[a]), swept))
          add('v', {g, k, a});
    }
    return found;
  }

private:
  using Vector = std::array<long double, 3>;

  struct Box {
    std::array<double, 3> lower, upper;
    Box() = default;
    explicit Box(const Point_3& p) : lower{p.x(), p.y(), p.z()}, upper(lower) {}
    Box& include(const Point_3& p) {
      for (int i = 0; i < 3; ++i) {
        lower[i] = std::fmin(lower[i], p[i]);
        upper[i] = std::fmax(upper[i], p[i]);
      }
      return *this;
    }
  };
  struct Face {
    Box box;
    std::array<std::size_t, 3> corners;
  };
  struct Edge {
    Box box;
    std::array<std::size_t, 2> ends;
  };

  std::vector<Point_3> points_;
  std::vector<std::size_t> link_;
  std::vector<Face> faces_;
  std::vector<Edge> edges_;
  std::vector<std::size_t> vertices_;

  static Vector minus(const Point_3& a, const Point_3& b) {
    return {static_cast<long double>(a.x()) - b.x(), static_cast<long double>(a.y()) - b.y(),
            static_cast<long double>(a.z()) - b.z()};
  }
  static Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
  static Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static long double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static long double length(const Vector& a) { return std::sqrt(dot(a, a)); }

  template <std::size_t N>
  Box box_of(const std::array<std::size_t, N>& corners) const {
    Box box(points_[corners[0]]);
    for (const std::size_t c : corners)
      box.include(points_[c]);
    return box;
  }
  static Box widened(Box box, double reach) {
    for (int i = 0; i < 3; ++i) {
      box.lower[i] -= 2 * reach;
      box.upper[i] += 2 * reach;
    }
    return box;
  }
  static bool meets(const Box& a, const Box& b) {
    for (int i = 0; i < 3; ++i)
      if (a.upper[i] < b.lower[i] || b.upper[i] < a.lower[i])
        return false;
    return true;
  }

  /// Calls `goes_on(kind, three points)` for each pair of features that could meet, until it returns false; tells
  /// whether it never did. Left out are only pairs with a common vertex that makes their meeting none.
  template <class Visitor>
  bool visit_pairs(const Point_3& s, const Point_3& t, const Visitor& goes_on) const {
    const Box path = Box(s).include(t);
    for (const Face& f : faces_)
      if (meets(f.box, path) &&
          !goes_on(Sweep_kind::vertex_face, points_[f.corners[0]], points_[f.corners[1]], points_[f.corners[2]]))
        return false;
    Box star = path;
    for (const std::size_t v : link_)
      star.include(points_[v]);
    if (!link_.empty())
      for (const Edge& e : edges_)
        if (meets(e.box, star))
          for (const std::size_t v : link_)
            if (e.ends[0] != v && e.ends[1] != v && meets(e.box, Box(path).include(points_[v])) &&
                !goes_on(Sweep_kind::edge_edge, points_[v], points_[e.ends[0]], points_[e.ends[1]]))
              return false;
    if (!link_.empty())
      for (const std::size_t a : vertices_)
        if (meets(Box(points_[a]), star))
          for (std::size_t i = 0; i < link_.size(); ++i) {
            const std::size_t g = link_[i], k = link_[(i + 1) % link_.size()];
            if (a != g && a != k && !goes_on(Sweep_kind::face_vertex, points_[g], points_[k], points_[a]))
              return false;
          }
    return true;
  }
};

} // namespace haptic_sculpt::test
