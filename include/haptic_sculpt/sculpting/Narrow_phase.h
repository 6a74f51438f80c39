// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_NARROW_PHASE_H
#define HAPTIC_SCULPT_SCULPTING_NARROW_PHASE_H

#include <haptic_sculpt/sculpting/Checklist.h>
#include <haptic_sculpt/sculpting/Star_impact.h>
#include <haptic_sculpt/sculpting/Swept_fan.h>

#include <limits>

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
  using Positions = std::vector<std::uint32_t>;

  /// Candidates that the boxes of some neighbouring faces of the star meet, as positions in the checklist.
  struct Near {
    Positions edges, vertices;
  };

  Counters* counters_;
  std::vector<Near> near_; ///< by depth; kept to allocate no more
  std::vector<internal::Vector> spokes_, places_; ///< of a star of many neighbours: link and candidate vertices, from `source`

  /// So many faces of a star are compared with the candidates one by one; more are halved first. A star of a thousand
  /// faces, each near few candidates, costs n log n that way, not n^2.
  static constexpr std::size_t few_faces = 3;
  static constexpr std::size_t few_faces_of_a_wedge = 8; ///< the same where planes are tried, too, which cost more than boxes
  /// Stars of more neighbours than this are worth planes between their parts and the candidates.
  static constexpr std::size_t many_neighbours = 16;

  /// One motion, as far as it is of interest.
  struct Motion {
    const Star<Mesh>& star;
    const Checklist<Mesh>& list;
    const Coordinates &source, &target;
    double reach;      ///< of the coordinates in spokes_ and places_; 0 where there are none
    double until = 1;  ///< a fraction of the way
    Box_3 path = Box_3(source).include(target); ///< holds the way until then

    Motion(const Star<Mesh>& s, const Checklist<Mesh>& l, const Coordinates& from, const Coordinates& to, double coordinates_reach)
      : star(s), list(l), source(from), target(to), reach(coordinates_reach) {}

    void shorten(double time) {
      if (!(time < until))
        return;
      until = time;
      path = Box_3(source);
      for (int i = 0; i < 3; ++i) {
        // The product and the two sums round by less than 4 units of the larger of the two ends.
        const double slack = 0x1p-50 * (std::abs(source[i]) + std::abs(target[i])) + std::numeric_limits<double>::min();
        const double end = source[i] + until * (target[i] - source[i]);
        if (!(std::abs(end) < std::numeric_limits<double>::infinity()))
          path.include(target);
        else if (target[i] > source[i])
          path.upper[i] = std::fmin(target[i], end + slack);
        else
          path.lower[i] = std::fmax(target[i], end - slack);
      }
    }
  };

  /// What `hit` returns when nothing more is of interest.
  static constexpr double enough = -1;

  /// Calls `hit(feature, vertices, points, verdict)` for every pair that meets. It returns the fraction of the way up to which hits are
  /// still of interest, or `enough`; later ones may be told or not. Returns whether it never was enough.
  template <class Hit>
  bool for_each_hit(const Star<Mesh>& star, const Checklist<Mesh>& list, const Coordinates& source,
                    const Coordinates& target, const Hit& hit) {
    if (source == target && star.valence() != 0)
      return true; // an embedded star that stands still touches nothing new
    Motion motion(star, list, source, target, place(star, list, source, target));
    const auto& vertices = list.vertices();
    for (const auto& face : list.faces()) {
      if (!do_meet(face.box, motion.path))
        continue;
      const auto &a = vertices[face.vertices[0]], &b = vertices[face.vertices[1]], &c = vertices[face.vertices[2]];
      const internal::Sweep_points points = {source, target, a.point, b.point, c.point};
      const internal::Sweep_verdict verdict = internal::vertex_face_verdict(points, *counters_);
      if (verdict.hits && !goes_on(motion, hit(Impact_feature::vertex_face, {a.index, b.index, c.index}, points, verdict)))
        return false;
    }
    return star.valence() == 0 || star_faces(motion, 0, star.valence(), 0, hit);
  }

  /// The faces [first, last) of the star with their edges, against the candidates that their box meets. `depth` times halved.
  template <class Hit>
  bool star_faces(Motion& motion, std::size_t first, std::size_t last, std::size_t depth, const Hit& hit) {
    if (near_.size() <= depth)
      near_.resize(depth + 1);
    const Star<Mesh>& star = motion.star;
    Box_3 box = motion.path;
    for (std::size_t i = first; i < last; ++i)
      box.include(star.link_points[i]);
    box.include(star.link_points[star.next(last - 1)]);
    near_[depth].edges.clear();
    near_[depth].vertices.clear();
    // All of a star, or half of it, is no wedge that planes at its ends could part from anything.
    const bool is_wedge = motion.reach > 0 && 4 * (last - first) <= star.valence();
    const internal::Swept_fan fan =
        is_wedge ? internal::Swept_fan(way_of_interest(motion), spokes_, first, last, motion.reach)
                 : internal::Swept_fan();
    const auto keep_edge = [&](std::uint32_t e) {
      const auto& edge = motion.list.edges()[e];
      if (do_meet(edge.box, box) && !(is_wedge && fan.is_apart(places_[edge.vertices[0]], places_[edge.vertices[1]])))
        near_[depth].edges.push_back(e);
    };
    const auto keep_vertex = [&](std::uint32_t v) {
      if (contains(box, motion.list.vertices()[v].point) && !(is_wedge && fan.is_apart(places_[v])))
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
    if (last - first > (is_wedge ? few_faces_of_a_wedge : few_faces)) {
      const std::size_t middle = first + (last - first) / 2;
      return star_faces(motion, first, middle, depth + 1, hit) && star_faces(motion, middle, last, depth + 1, hit);
    }
    for (std::size_t i = first; i < last; ++i)
      if (!moving_edge(motion, i, near_[depth].edges, hit) || !moving_face(motion, i, near_[depth].vertices, hit))
        return false;
    return true;
  }

  static bool goes_on(Motion& motion, double until) {
    motion.shorten(until);
    return until != enough;
  }

  static internal::Vector way_of_interest(const Motion& motion) {
    return internal::scaled(internal::minus(motion.target, motion.source), motion.until);
  }

  /// Fills spokes_ and places_ for a star of many neighbours. Returns how far coordinates reach.
  double place(const Star<Mesh>& star, const Checklist<Mesh>& list, const Coordinates& source, const Coordinates& target) {
    if (star.valence() <= many_neighbours)
      return 0;
    double reach = internal::largest_magnitude(internal::minus(target, source));
    const auto from_source = [&](const Coordinates& p) {
      const internal::Vector place = internal::minus(p, source);
      reach = std::fmax(reach, internal::largest_magnitude(place));
      return place;
    };
    spokes_.clear();
    for (const Coordinates& p : star.link_points)
      spokes_.push_back(from_source(p));
    places_.clear();
    for (const auto& vertex : list.vertices())
      places_.push_back(from_source(vertex.point));
    return reach;
  }

  template <class Hit>
  bool moving_edge(Motion& motion, std::size_t i, const Positions& edges, const Hit& hit) const {
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
      if (verdict.hits && !goes_on(motion, hit(Impact_feature::edge_edge, {far_end, low.index, high.index}, points, verdict)))
        return false;
    }
    return true;
  }

  template <class Hit>
  bool moving_face(Motion& motion, std::size_t i, const Positions& vertices, const Hit& hit) const {
    const Star<Mesh>& star = motion.star;
    const std::size_t j = star.next(i);
    const Box_3 swept = Box_3(motion.path).include(star.link_points[i]).include(star.link_points[j]);
    for (const std::uint32_t v : vertices) {
      const auto& vertex = motion.list.vertices()[v];
      if (!contains(swept, vertex.point) || vertex.index == star.link[i] || vertex.index == star.link[j])
        continue;
      const internal::Sweep_points points = {motion.source, motion.target, star.link_points[i], star.link_points[j], vertex.point};
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
