// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision.h>
#include <haptic_sculpt/sculpting/culling/Star_runs.h>
#include <haptic_sculpt/surface/delta_rule.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <CGAL/Kernel_traits.h>

namespace haptic_sculpt::internal {

/// A corner of a triangle: who it is, and where.
template <class Mesh>
struct Corner {
  typename Mesh::Vertex_index index; ///< the null index for a vertex that is to be created
  Coordinates point;
};

template <class Mesh>
using Corners = std::array<Corner<Mesh>, 3>;

/// The corners of the triangle at h, from its source on.
template <class Mesh>
Corners<Mesh> corners_at(const Mesh& mesh, typename Mesh::Halfedge_index h) {
  Corners<Mesh> result;
  for (Corner<Mesh>& corner : result) {
    corner = {mesh.source(h), vertex_coordinates(mesh, mesh.source(h))};
    h = mesh.next(h);
  }
  return result;
}

template <class Mesh>
bool keeps_delta(const Coordinates& a, const Coordinates& b, const Coordinates& c, double delta) {
  using Point = typename Mesh::Point;
  const auto point = [](const Coordinates& p) { return Point(p[0], p[1], p[2]); };
  return Satisfies_delta_rule_3<typename CGAL::Kernel_traits<Point>::Kernel>(delta)(point(a), point(b), point(c));
}

/// Exact decisions about creations, collapses and flips. See doc/use/edits.md.
template <class Mesh, class Counters>
class Edit_proof {
public:
  using Vertex_index = typename Mesh::Vertex_index;

  explicit Edit_proof(Counters& counters) : counters_(&counters) {}

  /// Whether two triangles with different corners share a point that is not in a common vertex or edge.
  bool meet_improperly(Corners<Mesh> f, Corners<Mesh> g) const {
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = shared; j < 3; ++j)
        if (f[i].index == g[j].index) {
          std::swap(f[i], f[shared]);
          std::swap(g[j], g[shared]);
          ++shared;
          break;
        }
    if (shared == 2) // about one edge they meet elsewhere only when folded onto each other
      return orientation_3(f[0].point, f[1].point, f[2].point, g[2].point, *counters_) == 0 && are_folded(f, g);
    if (shared == 1)
      return meets(f[1], f[2], g) || meets(g[1], g[2], f);
    for (std::size_t i = 0; i < 3; ++i)
      if (meets(f[i], f[(i + 1) % 3], g) || meets(g[i], g[(i + 1) % 3], f))
        return true;
    return false;
  }

  /// Whether a vertex lies in the closed tetrahedron of a triangle and a point.
  bool contains(const Corners<Mesh>& base, const Coordinates& apex, const Coordinates& vertex) const {
    return do_meet(Box_3(vertex), box(base).include(apex)) &&
           face_vertex_verdict(Sweep_points{base[0].point, apex, base[1].point, base[2].point, vertex}, *counters_)
               .hits;
  }

  /// The sweeps of a star's centre into its neighbour `link[pivot]`, for the collapse that follows: true when nothing
  /// but the faces that vanish is touched. `list` holds the faces not incident to the centre.
  template <class Elements>
  bool can_collapse(const Star<Mesh>& star, const Candidate_list<Mesh>& list, const Coordinates& centre,
                    std::size_t pivot, Elements& in_the_way) {
    const std::size_t n = star.valence();
    const std::size_t left = pivot + 1 < n ? pivot + 1 : 0, right = pivot > 0 ? pivot - 1 : n - 1;
    const Vertex_index apex = star.link[pivot];
    const Coordinates& target = star.link_points[pivot];
    const auto& vertices = list.vertices();
    // The least that the first spoke or face in the way meets, so that what is reported does not depend on the order of
    // the list.
    const auto note = [&](Elements found) {
      if (in_the_way.empty() || found < in_the_way)
        in_the_way = std::move(found);
    };
    const auto moving_edge = [&](std::size_t i, const auto& run) {
      const Box_3 swept = Box_3(centre).include(target).include(star.link_points[i]);
      run.for_each_edge_near(i, [&](std::uint32_t e) {
        const auto& edge = list.edges()[e];
        const auto &a = vertices[edge[0]], &b = vertices[edge[1]];
        if (a.index != apex && b.index != apex &&
            do_meet(list.box(edge), swept) &&
            edge_edge_verdict(Sweep_points{centre, target, star.link_points[i], a.point, b.point}, *counters_).hits)
          note({std::min(a.index, b.index), std::max(a.index, b.index)});
      });
    };
    const auto moving_face = [&](std::size_t i, std::size_t j, const auto& run) {
      const Box_3 swept = Box_3(centre).include(target).include(star.link_points[i]).include(star.link_points[j]);
      run.for_each_vertex_near(i, [&](std::uint32_t v) {
        const auto& vertex = vertices[v];
        if (vertex.index != apex &&
            haptic_sculpt::contains(swept, vertex.point) &&
            face_vertex_verdict(Sweep_points{centre, target, star.link_points[i], star.link_points[j], vertex.point},
                                *counters_)
                .hits)
          note({vertex.index});
      });
    };
    Star_motion motion(centre, target);
    return runs_.for_each_run(star, list, motion, 0,
                              [&](const auto& run) {
                                for (std::size_t i = run.first; i < run.last && in_the_way.empty(); ++i)
                                  if (i != pivot && i != left && i != right)
                                    moving_edge(i, run);
                                return in_the_way.empty();
                              }) &&
           runs_.for_each_run(star, list, motion, 0, [&](const auto& run) {
             for (std::size_t i = run.first; i < run.last && in_the_way.empty(); ++i)
               if (i != pivot && star.next(i) != pivot)
                 moving_face(i, star.next(i), run);
             return in_the_way.empty();
           });
  }

  /// Makes room for this many candidates of a collapse.
  void reserve(std::size_t valence, std::size_t vertices, std::size_t edges) {
    runs_.reserve(valence, vertices, edges);
  }

private:
  Counters* counters_;
  Star_runs<Mesh> runs_;

  static Box_3 box(const Corners<Mesh>& f) { return Box_3(f[0].point).include(f[1].point).include(f[2].point); }

  /// The boxes are exact and closed, so what they rule out does not meet.
  bool meets(const Corner<Mesh>& a, const Corner<Mesh>& b, const Corners<Mesh>& f) const {
    return do_meet(Box_3(a.point).include(b.point), box(f)) &&
           vertex_face_verdict(Sweep_points{a.point, b.point, f[0].point, f[1].point, f[2].point}, *counters_).hits;
  }

  /// Whether the third corners lie on one side of the shared edge. \pre coplanar, neither triangle degenerate
  bool are_folded(const Corners<Mesh>& f, const Corners<Mesh>& g) const {
    for (int axis = 0; axis < 3; ++axis) {
      const int side = orientation_2(f[0].point, f[1].point, f[2].point, axis, *counters_);
      if (side != 0)
        return side == orientation_2(f[0].point, f[1].point, g[2].point, axis, *counters_);
    }
    return true;
  }
};

} // namespace haptic_sculpt::internal
