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
  bool is_free(const Star<Mesh>& star, const Checklist<Mesh>& list, const Coordinates& source, const Coordinates& target) {
    return for_each_hit(star, list, source, target,
                        [&](Impact_feature, const std::array<Vertex_index, 3>&, const internal::Sweep_points&,
                            const internal::Sweep_verdict&) { return false; });
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
                   return true;
                 });
    std::sort(firsts.begin(), firsts.end());
  }

private:
  using Positions = std::vector<std::uint32_t>;

  /// Candidates that the boxes of some neighbouring faces of the star meet, as positions in the checklist.
  struct Near {
    Positions edges, vertices;
  };

  Counters* counters_;
  std::vector<Near> near_; ///< by depth; kept to allocate no more

  /// So many faces of a star are compared with the candidates one by one; more are halved first. A star of a thousand
  /// faces, each near few candidates, costs n log n that way, not n^2.
  static constexpr std::size_t few_faces = 3;

  /// One motion.
  struct Motion {
    const Star<Mesh>& star;
    const Checklist<Mesh>& list;
    const Coordinates &source, &target;
    Box_3 path;
  };

  /// Calls `hit(feature, vertices, points, verdict)` for every pair that meets, until it returns false; returns whether it
  /// never did.
  template <class Hit>
  bool for_each_hit(const Star<Mesh>& star, const Checklist<Mesh>& list, const Coordinates& source,
                    const Coordinates& target, const Hit& hit) {
    if (source == target && star.valence() != 0)
      return true; // an embedded star that stands still touches nothing new
    const Motion motion = {star, list, source, target, Box_3(source).include(target)};
    const auto& vertices = list.vertices();
    for (const auto& face : list.faces()) {
      if (!do_meet(face.box, motion.path))
        continue;
      const auto &a = vertices[face.vertices[0]], &b = vertices[face.vertices[1]], &c = vertices[face.vertices[2]];
      const internal::Sweep_points points = {source, target, a.point, b.point, c.point};
      const internal::Sweep_verdict verdict = internal::vertex_face_verdict(points, *counters_);
      if (verdict.hits && !hit(Impact_feature::vertex_face, {a.index, b.index, c.index}, points, verdict))
        return false;
    }
    return star.valence() == 0 || star_faces(motion, 0, star.valence(), 0, hit);
  }

  /// The faces [first, last) of the star with their edges, against the candidates that their box meets. `depth` times halved.
  template <class Hit>
  bool star_faces(const Motion& motion, std::size_t first, std::size_t last, std::size_t depth, const Hit& hit) {
    if (near_.size() <= depth)
      near_.resize(depth + 1);
    const Star<Mesh>& star = motion.star;
    Box_3 box = motion.path;
    for (std::size_t i = first; i < last; ++i)
      box.include(star.link_points[i]);
    box.include(star.link_points[star.next(last - 1)]);
    near_[depth].edges.clear();
    near_[depth].vertices.clear();
    const auto keep_edge = [&](std::uint32_t e) {
      if (do_meet(motion.list.edges()[e].box, box))
        near_[depth].edges.push_back(e);
    };
    const auto keep_vertex = [&](std::uint32_t v) {
      if (contains(box, motion.list.vertices()[v].point))
        near_[depth].vertices.push_back(v);
    };
    if (depth == 0) {
      for (std::uint32_t e = 0; e < motion.list.edges().size(); ++e)
        keep_edge(e);
      for (std::uint32_t v = 0; v < motion.list.vertices().size(); ++v)
        keep_vertex(v);
    } else {
      for (const std::uint32_t e : near_[depth - 1].edges)
        keep_edge(e);
      for (const std::uint32_t v : near_[depth - 1].vertices)
        keep_vertex(v);
    }
    if (last - first > few_faces) {
      const std::size_t middle = first + (last - first) / 2;
      return star_faces(motion, first, middle, depth + 1, hit) && star_faces(motion, middle, last, depth + 1, hit);
    }
    for (std::size_t i = first; i < last; ++i)
      if (!moving_edge(motion, i, near_[depth].edges, hit) || !moving_face(motion, i, near_[depth].vertices, hit))
        return false;
    return true;
  }

  template <class Hit>
  bool moving_edge(const Motion& motion, std::size_t i, const Positions& edges, const Hit& hit) const {
    const auto& vertices = motion.list.vertices();
    const Vertex_index far_end = motion.star.link[i];
    const Coordinates& far_point = motion.star.link_points[i];
    const Box_3 swept = Box_3(motion.path).include(far_point);
    for (const std::uint32_t e : edges) {
      const auto& edge = motion.list.edges()[e];
      if (!do_meet(edge.box, swept))
        continue;
      const auto &a = vertices[edge.vertices[0]], &b = vertices[edge.vertices[1]];
      if (a.index == far_end || b.index == far_end)
        continue;
      // The smaller name first, whatever the list's order: what is told does not depend on the broad phase.
      const auto &low = a.index < b.index ? a : b, &high = a.index < b.index ? b : a;
      const internal::Sweep_points points = {motion.source, motion.target, far_point, low.point, high.point};
      const internal::Sweep_verdict verdict = internal::edge_edge_verdict(points, *counters_);
      if (verdict.hits && !hit(Impact_feature::edge_edge, {far_end, low.index, high.index}, points, verdict))
        return false;
    }
    return true;
  }

  template <class Hit>
  bool moving_face(const Motion& motion, std::size_t i, const Positions& vertices, const Hit& hit) const {
    const Star<Mesh>& star = motion.star;
    const std::size_t j = star.next(i);
    const Box_3 swept = Box_3(motion.path).include(star.link_points[i]).include(star.link_points[j]);
    for (const std::uint32_t v : vertices) {
      const auto& vertex = motion.list.vertices()[v];
      if (!contains(swept, vertex.point) || vertex.index == star.link[i] || vertex.index == star.link[j])
        continue;
      const internal::Sweep_points points = {motion.source, motion.target, star.link_points[i], star.link_points[j], vertex.point};
      const internal::Sweep_verdict verdict = internal::face_vertex_verdict(points, *counters_);
      if (verdict.hits && !hit(Impact_feature::face_vertex, {star.link[i], star.link[j], vertex.index}, points, verdict))
        return false;
    }
    return true;
  }
};

} // namespace haptic_sculpt

#endif
