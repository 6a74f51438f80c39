// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Star_impact.h>
#include <haptic_sculpt/sculpting/culling/Near_pairs.h>
#include <haptic_sculpt/sculpting/geometry/Work.h>

namespace haptic_sculpt::internal {

/// All three sweeps of a star against its candidates (completeness: doc/proofs/exact_sweeps.md).
///
/// A pair is left out only when its boxes do not meet, which is decided exactly, when a plane lies certainly between
/// its two, when it cannot come first any more, or when it shares a vertex that makes its meeting no collision: faces
/// incident to the moving vertex, edges at the far end of the moving edge. All of this is exact whatever the traits;
/// they decide the pairs that are left, and which of two impacts is first.
/// \tparam Traits a model of SweptCollisionTraits_3 \pre of all functions: a Rounding_to_nearest lives
template <class Mesh, class Traits = Exact_sweep_traits<Mesh>>
class Narrow_phase {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Impacts = Star_impacts<Mesh, typename Traits::Impact_3>;

  explicit Narrow_phase(const Traits& traits)
      : traits_(traits)
      , vertex_face_(traits_.vertex_face_sweep_3_object())
      , edge_edge_(traits_.edge_edge_sweep_3_object())
      , face_vertex_(traits_.face_vertex_sweep_3_object())
      , compare_time_(traits_.compare_time_3_object()) {}
  Narrow_phase(const Narrow_phase&) = delete; // what the traits made may refer to them
  Narrow_phase& operator=(const Narrow_phase&) = delete;

  /// Whether nothing is touched on the closed way from source to target.
  bool is_free(const Star<Mesh>& star, const Candidate_list<Mesh>& list, const Coordinates& source,
               const Coordinates& target) {
    return for_each_hit({star, list, {source, target}}, Any());
  }

  /// The same where pairs cover the motion. \pre pairs.cover(source, target), and they are of this star and list
  bool is_free(const Star<Mesh>& star, const Candidate_list<Mesh>& list, const Near_pairs<Mesh>& pairs,
               const Coordinates& source, const Coordinates& target) {
    return for_each_hit({star, list, {source, target}}, pairs, Any());
  }

  /// Fills `firsts` with the impacts that come exactly first; leaves it empty when the way is free.
  void first_impacts(const Star<Mesh>& star, const Candidate_list<Mesh>& list, const Coordinates& source,
                     const Coordinates& target, Impacts& firsts) {
    first_impacts_near(star, list, source, target, Box_3(source).include(target), firsts);
  }

  /// The same among the pairs that may meet while J is in the box `path`: what comes first while it is there comes
  /// first of all.
  void first_impacts_near(const Star<Mesh>& star, const Candidate_list<Mesh>& list, const Coordinates& source,
                          const Coordinates& target, const Box_3& path, Impacts& firsts) {
    firsts.clear();
    for_each_hit({star, list, {source, target, path}}, Keep_first{firsts, compare_time_});
    std::sort(firsts.begin(), firsts.end());
  }

  /// The same where pairs cover the motion. \pre pairs.cover(source, target), and they are of this star and list
  void first_impacts(const Star<Mesh>& star, const Candidate_list<Mesh>& list, const Near_pairs<Mesh>& pairs,
                     const Coordinates& source, const Coordinates& target, Impacts& firsts) {
    firsts.clear();
    for_each_hit({star, list, {source, target}}, pairs, Keep_first{firsts, compare_time_});
    std::sort(firsts.begin(), firsts.end());
  }

  /// Working memory, to be shared.
  Star_runs<Mesh>& runs() { return runs_; }

  /// Each pair that is swept counts. Once the bound is passed nothing more is decided: no way is free then, and no
  /// impacts are reported.
  Work& work() { return work_; }
  const Work& work() const { return work_; }

private:
  using Vertices = std::array<Vertex_index, 3>;
  using Point_3 = typename Mesh::Point;
  using Compare_time = typename In_set_mode<typename Traits::Compare_time_3>::type;

  Traits traits_;
  typename In_set_mode<typename Traits::Vertex_face_sweep_3>::type vertex_face_;
  typename In_set_mode<typename Traits::Edge_edge_sweep_3>::type edge_edge_;
  typename In_set_mode<typename Traits::Face_vertex_sweep_3>::type face_vertex_;
  Compare_time compare_time_;
  Star_runs<Mesh> runs_;
  Work work_;

  /// One motion, and what is in its way.
  struct Scene {
    const Star<Mesh>& star;
    const Candidate_list<Mesh>& list;
    Star_motion motion;
  };

  /// What is done with a pair, `hit(sweep, vertices, s, t, a, b, c)`: it asks the sweep, and tells up to what fraction
  /// of the way hits are of interest from then on (later ones may be reported or not), or that it has enough.
  static constexpr double enough = -1, whole_way = 1;

  struct Any {
    template <class Sweep>
    double operator()(const Sweep& sweep, const Vertices&, const Point_3& s, const Point_3& t, const Point_3& a,
                      const Point_3& b, const Point_3& c) const {
      return sweep.do_collide(s, t, a, b, c) ? enough : whole_way;
    }
  };
  struct Keep_first {
    Impacts& firsts;
    const Compare_time& compare;

    template <class Sweep>
    double operator()(const Sweep& sweep, const Vertices& vertices, const Point_3& s, const Point_3& t,
                      const Point_3& a, const Point_3& b, const Point_3& c) const {
      const auto impact = sweep(s, t, a, b, c);
      if (!impact)
        return whole_way;
      const int order = firsts.empty() ? -1 : static_cast<int>(compare(*impact, firsts[0].impact()));
      if (order < 0)
        firsts.clear();
      if (order <= 0)
        firsts.emplace_back(vertices, *impact);
      return order < 0 ? time_bounds_in_set_mode(*impact).second : whole_way;
    }
  };

  /// Tells of every pair that meets; returns whether no telling ended it.
  template <class Hit>
  bool for_each_hit(Scene scene, const Hit& hit) {
    if (stands_still(scene))
      return true;
    const auto vertex = [&](std::uint32_t f) { return vertex_on_face(scene, f, hit); };
    if (scene.star.valence() == 0 || scene.star.valence() > Separating_planes::most_faces)
      for (std::uint32_t f = 0; f < scene.list.faces().size(); ++f)
        if (!vertex(f))
          return false;
    return scene.star.valence() == 0 ||
           runs_.for_each_run(scene.star, scene.list, scene.motion, 0, [&](const auto& run) {
             return (!run.is_whole || run.for_each_face(vertex)) &&
                    run.for_each_edge_pair(
                        [&](std::size_t i, std::uint32_t e) { return moving_edge(scene, i, e, hit); }) &&
                    run.for_each_vertex_pair(
                        [&](std::size_t i, std::uint32_t v) { return moving_face(scene, i, v, hit); });
           });
  }

  template <class Hit>
  bool for_each_hit(Scene scene, const Near_pairs<Mesh>& pairs, const Hit& hit) {
    return stands_still(scene) ||
           pairs.for_each_near(scene.motion.source(), scene.motion.target(),
                               [&](const typename Near_pairs<Mesh>::Pair& pair) {
                                 switch (pair.feature) {
                                 case Impact_feature::vertex_face:
                                   return vertex_on_face(scene, pair.candidate, hit);
                                 case Impact_feature::edge_edge:
                                   return moving_edge(scene, pair.spoke, pair.candidate, hit);
                                 default:
                                   return moving_face(scene, pair.spoke, pair.candidate, hit);
                                 }
                               });
  }

  /// An embedded star that stands still touches nothing new.
  static bool stands_still(const Scene& scene) {
    return scene.motion.source() == scene.motion.target() && scene.star.valence() != 0;
  }

  /// Asks of one pair; returns whether there is to be another.
  template <class Sweep, class Hit>
  bool goes_on(Scene& scene, const Hit& hit, const Sweep& sweep, const Vertices& vertices, const Coordinates& a,
               const Coordinates& b, const Coordinates& c) {
    work_.spend();
    if (work_.is_spent())
      return false;
    const double until =
        hit(sweep, vertices, point(scene.motion.source()), point(scene.motion.target()), point(a), point(b), point(c));
    if (until == enough)
      return false;
    scene.motion.shorten(until);
    return true;
  }
  static Point_3 point(const Coordinates& p) { return Point_3(p[0], p[1], p[2]); }

  template <class Hit>
  bool vertex_on_face(Scene& scene, std::uint32_t f, const Hit& hit) {
    const auto& face = scene.list.faces()[f];
    if (!do_meet(scene.list.box(face), scene.motion.path()))
      return true;
    const auto& vertices = scene.list.vertices();
    const auto &a = vertices[face.vertices[0]], &b = vertices[face.vertices[1]], &c = vertices[face.vertices[2]];
    return goes_on(scene, hit, vertex_face_, Vertices{a.index, b.index, c.index}, a.point, b.point, c.point);
  }

  /// The edge to link vertex i against a candidate.
  template <class Hit>
  bool moving_edge(Scene& scene, std::size_t i, std::uint32_t e, const Hit& hit) {
    const auto& edge = scene.list.edges()[e];
    const auto& vertices = scene.list.vertices();
    const Vertex_index far_end = scene.star.link[i];
    const Coordinates& far_point = scene.star.link_points[i];
    const auto &a = vertices[edge[0]], &b = vertices[edge[1]];
    if (!do_meet(scene.list.box(edge), Box_3(scene.motion.path()).include(far_point)))
      return true;
    // The smaller name first, whatever the list's order: what is reported does not depend on the broad phase.
    const auto &low = a.index < b.index ? a : b, &high = a.index < b.index ? b : a;
    return goes_on(scene, hit, edge_edge_, Vertices{far_end, low.index, high.index}, far_point, low.point, high.point);
  }

  /// Face i against a candidate.
  template <class Hit>
  bool moving_face(Scene& scene, std::size_t i, std::uint32_t v, const Hit& hit) {
    const Star<Mesh>& star = scene.star;
    const std::size_t j = star.next(i);
    const auto& vertex = scene.list.vertices()[v];
    if (!contains(Box_3(scene.motion.path()).include(star.link_points[i]).include(star.link_points[j]), vertex.point))
      return true;
    return goes_on(scene, hit, face_vertex_, Vertices{star.link[i], star.link[j], vertex.index}, star.link_points[i],
                   star.link_points[j], vertex.point);
  }
};

} // namespace haptic_sculpt::internal
