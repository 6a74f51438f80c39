// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_NARROW_PHASE_H
#define HAPTIC_SCULPT_SCULPTING_NARROW_PHASE_H

#include <haptic_sculpt/sculpting/Checklist.h>
#include <haptic_sculpt/sculpting/Star_impact.h>

namespace haptic_sculpt {

/// All three sweeps of a star against a checklist (PAPER B; completeness: doc/exact_sweeps.md).
///
/// A pair is left out only when its boxes do not meet, which is decided exactly, or when it shares a vertex that makes
/// its meeting no collision: faces incident to the moving vertex, edges at the far end of the moving edge.
template <class Mesh, class Counters = Filter_counters>
class Narrow_phase {
public:
  using Coordinates = internal::Coordinates;
  using Vertex_index = typename Mesh::Vertex_index;

  explicit Narrow_phase(Counters& counters) : counters_(&counters) {}

  /// Whether nothing is touched on the closed way from source to target.
  bool is_free(const Star<Mesh>& star, const Checklist<Mesh>& list, const Coordinates& source,
               const Coordinates& target) const {
    bool free = true;
    for_each_hit(star, list, source, target, [&](Impact_feature, const std::array<Vertex_index, 3>&, const internal::Sweep_points&,
                     const internal::Sweep_verdict&) { return free = false; });
    return free;
  }

  /// Fills `firsts` with the impacts that come exactly first; leaves it empty when the way is free.
  void first_impacts(const Star<Mesh>& star, const Checklist<Mesh>& list, const Coordinates& source,
                     const Coordinates& target, Star_impacts<Mesh>& firsts) const {
    firsts.clear();
    for_each_hit(star, list, source, target,
                 [&](Impact_feature feature, const std::array<Vertex_index, 3>& vertices,
                     const internal::Sweep_points& points, const internal::Sweep_verdict& verdict) {
                   const int order =
                       firsts.empty() ? -1
                                      : internal::compare_times(points, verdict, firsts[0].impact().coordinates(),
                                                                firsts[0].impact().verdict(), *counters_);
                   if (order < 0)
                     firsts.clear();
                   if (order <= 0)
                     firsts.emplace_back(feature, vertices, points, verdict);
                   return true;
                 });
    std::sort(firsts.begin(), firsts.end());
  }

private:
  Counters* counters_;

  /// Calls `hit(feature, vertices, points, verdict)` for every pair that meets, until it returns false.
  template <class Hit>
  void for_each_hit(const Star<Mesh>& star, const Checklist<Mesh>& list, const Coordinates& source,
                    const Coordinates& target, const Hit& hit) const {
    if (source == target && star.valence() != 0)
      return; // an embedded star that stands still touches nothing new
    const Box_3 path = Box_3(source).include(target);
    const auto& vertices = list.vertices();
    for (const auto& face : list.faces()) {
      if (!do_meet(face.box, path))
        continue;
      const auto &a = vertices[face.vertices[0]], &b = vertices[face.vertices[1]], &c = vertices[face.vertices[2]];
      const internal::Sweep_points points = {source, target, a.point, b.point, c.point};
      const internal::Sweep_verdict verdict = internal::vertex_face_verdict(points, *counters_);
      if (verdict.hits && !hit(Impact_feature::vertex_face, {a.index, b.index, c.index}, points, verdict))
        return;
    }
    for (std::size_t i = 0; i < star.valence(); ++i) {
      const Vertex_index far_end = star.link[i];
      const Coordinates& far_point = star.link_points[i];
      const Box_3 swept = Box_3(path).include(far_point);
      for (const auto& edge : list.edges()) {
        if (!do_meet(edge.box, swept))
          continue;
        const auto &a = vertices[edge.vertices[0]], &b = vertices[edge.vertices[1]];
        if (a.index == far_end || b.index == far_end)
          continue;
        const internal::Sweep_points points = {source, target, far_point, a.point, b.point};
        const internal::Sweep_verdict verdict = internal::edge_edge_verdict(points, *counters_);
        if (verdict.hits && !hit(Impact_feature::edge_edge, {far_end, a.index, b.index}, points, verdict))
          return;
      }
    }
    for (std::size_t i = 0; i < star.valence(); ++i) {
      const std::size_t j = star.next(i);
      const Box_3 swept = Box_3(path).include(star.link_points[i]).include(star.link_points[j]);
      for (const auto& vertex : vertices) {
        if (!do_meet(Box_3(vertex.point), swept) || vertex.index == star.link[i] || vertex.index == star.link[j])
          continue;
        const internal::Sweep_points points = {source, target, star.link_points[i], star.link_points[j], vertex.point};
        const internal::Sweep_verdict verdict = internal::face_vertex_verdict(points, *counters_);
        if (verdict.hits && !hit(Impact_feature::face_vertex, {star.link[i], star.link[j], vertex.index}, points, verdict))
          return;
      }
    }
  }
};

} // namespace haptic_sculpt

#endif
