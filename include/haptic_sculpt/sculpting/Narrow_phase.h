// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_NARROW_PHASE_H
#define HAPTIC_SCULPT_SCULPTING_NARROW_PHASE_H

#include <haptic_sculpt/sculpting/Star_impact.h>
#include <haptic_sculpt/sculpting/Star_runs.h>

namespace haptic_sculpt {

/// All three sweeps of a star against a checklist (PAPER B; completeness: doc/exact_sweeps.md).
///
/// A pair is left out only when its boxes do not meet, which is decided exactly, when a plane lies certainly between its two, or when it
/// shares a vertex that makes its meeting no collision: faces incident to the moving vertex, edges at the far end of the moving edge.
template <class Mesh, class Counters = Filter_counters>
class Narrow_phase {
public:
  using Coordinates = internal::Coordinates;
  using Vertex_index = typename Mesh::Vertex_index;

  explicit Narrow_phase(Counters& counters) : counters_(&counters) {}

  /// Whether nothing is touched on the closed way from source to target.
  bool is_free(const Star<Mesh>& star, const Checklist<Mesh>& list, const Coordinates& source, const Coordinates& target) {
    return for_each_hit(star, list, source, target,
                        [&](Impact_feature, const std::array<Vertex_index, 3>&, const internal::Sweep_points&,
                            const internal::Sweep_verdict&) { return enough; });
  }

  /// Fills `firsts` with the impacts that come exactly first; leaves it empty when the way is free.
  void first_impacts(const Star<Mesh>& star, const Checklist<Mesh>& list, const Coordinates& source,
                     const Coordinates& target, Star_impacts<Mesh>& firsts) {
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
                   return order < 0 ? internal::filtered_time(points, verdict).second : 1;
                 });
    std::sort(firsts.begin(), firsts.end());
  }

private:
  using Motion = internal::Star_motion;
  using Positions = typename internal::Star_runs<Mesh>::Positions;

  Counters* counters_;
  internal::Star_runs<Mesh> runs_;

  /// What `hit` returns when nothing more is of interest.
  static constexpr double enough = -1;

  /// Calls `hit(feature, vertices, points, verdict)` for every pair that meets. It returns the fraction of the way up to which hits are
  /// still of interest, or `enough`; later ones may be told or not. Returns whether it never was enough.
  template <class Hit>
  bool for_each_hit(const Star<Mesh>& star, const Checklist<Mesh>& list, const Coordinates& source,
                    const Coordinates& target, const Hit& hit) {
    if (source == target && star.valence() != 0)
      return true; // an embedded star that stands still touches nothing new
    Motion motion(source, target);
    const auto& vertices = list.vertices();
    for (const auto& face : list.faces()) {
      if (!do_meet(face.box, motion.path()))
        continue;
      const auto &a = vertices[face.vertices[0]], &b = vertices[face.vertices[1]], &c = vertices[face.vertices[2]];
      const internal::Sweep_points points = {source, target, a.point, b.point, c.point};
      const internal::Sweep_verdict verdict = internal::vertex_face_verdict(points, *counters_);
      if (verdict.hits && !goes_on(motion, hit(Impact_feature::vertex_face, {a.index, b.index, c.index}, points, verdict)))
        return false;
    }
    return star.valence() == 0 ||
           runs_.for_each_run(star, list, motion,
                              [&](std::size_t first, std::size_t last, const Positions& near_edges, const Positions& near_vertices) {
                                for (std::size_t i = first; i < last; ++i)
                                  if (!moving_edge(star, list, motion, i, near_edges, hit) ||
                                      !moving_face(star, list, motion, i, near_vertices, hit))
                                    return false;
                                return true;
                              });
  }

  static bool goes_on(Motion& motion, double until) {
    motion.shorten(until);
    return until != enough;
  }

  template <class Hit>
  bool moving_edge(const Star<Mesh>& star, const Checklist<Mesh>& list, Motion& motion, std::size_t i, const Positions& edges,
                   const Hit& hit) const {
    const auto& vertices = list.vertices();
    const Vertex_index far_end = star.link[i];
    const Coordinates& far_point = star.link_points[i];
    const Box_3 swept = Box_3(motion.path()).include(far_point);
    for (const std::uint32_t e : edges) {
      const auto& edge = list.edges()[e];
      if (!do_meet(edge.box, swept))
        continue;
      const auto &a = vertices[edge.vertices[0]], &b = vertices[edge.vertices[1]];
      if (a.index == far_end || b.index == far_end)
        continue;
      // The smaller name first, whatever the list's order: what is told does not depend on the broad phase.
      const auto &low = a.index < b.index ? a : b, &high = a.index < b.index ? b : a;
      const internal::Sweep_points points = {motion.source(), motion.target(), far_point, low.point, high.point};
      const internal::Sweep_verdict verdict = internal::edge_edge_verdict(points, *counters_);
      if (verdict.hits && !goes_on(motion, hit(Impact_feature::edge_edge, {far_end, low.index, high.index}, points, verdict)))
        return false;
    }
    return true;
  }

  template <class Hit>
  bool moving_face(const Star<Mesh>& star, const Checklist<Mesh>& list, Motion& motion, std::size_t i, const Positions& vertices,
                   const Hit& hit) const {
    const std::size_t j = star.next(i);
    const Box_3 swept = Box_3(motion.path()).include(star.link_points[i]).include(star.link_points[j]);
    for (const std::uint32_t v : vertices) {
      const auto& vertex = list.vertices()[v];
      if (!contains(swept, vertex.point) || vertex.index == star.link[i] || vertex.index == star.link[j])
        continue;
      const internal::Sweep_points points = {motion.source(), motion.target(), star.link_points[i],
                                               star.link_points[j], vertex.point};
      const internal::Sweep_verdict verdict = internal::face_vertex_verdict(points, *counters_);
      if (verdict.hits &&
          !goes_on(motion, hit(Impact_feature::face_vertex, {star.link[i], star.link[j], vertex.index}, points, verdict)))
        return false;
    }
    return true;
  }
};

} // namespace haptic_sculpt

#endif
