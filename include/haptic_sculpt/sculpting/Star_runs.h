// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_STAR_RUNS_H
#define HAPTIC_SCULPT_SCULPTING_STAR_RUNS_H

#include <haptic_sculpt/sculpting/Checklist.h>
#include <haptic_sculpt/sculpting/Swept_fan.h>

#include <limits>

namespace haptic_sculpt {
namespace internal {

/// The straight motion of a star's centre, as far as it is of interest.
class Star_motion {
public:
  using Coordinates = std::array<double, 3>;

  Star_motion(const Coordinates& source, const Coordinates& target)
    : source_(source), target_(target), path_(Box_3(source).include(target)) {}

  const Coordinates& source() const { return source_; }
  const Coordinates& target() const { return target_; }

  /// Holds the way as far as it is of interest.
  const Box_3& path() const { return path_; }

  /// About the vector of that way.
  Vector way() const { return scaled(minus(target_, source_), until_); }

  /// Only what happens up to `time`, a fraction of the way, is of interest from now on.
  void shorten(double time) {
    if (!(time < until_))
      return;
    until_ = time;
    path_ = Box_3(source_);
    for (int i = 0; i < 3; ++i) {
      // The product and the two sums round by less than 4 units of the larger of the two ends.
      const double slack = 0x1p-50 * (std::abs(source_[i]) + std::abs(target_[i])) + std::numeric_limits<double>::min();
      const double end = source_[i] + until_ * (target_[i] - source_[i]);
      if (!(std::abs(end) < std::numeric_limits<double>::infinity()))
        path_.include(target_);
      else if (target_[i] > source_[i])
        path_.upper[i] = std::fmin(target_[i], end + slack);
      else
        path_.lower[i] = std::fmax(target_[i], end - slack);
    }
  }

private:
  Coordinates source_, target_;
  double until_ = 1;
  Box_3 path_;
};

/// Goes through the faces of a star in runs of a few, each with the candidates that are near it.
///
/// The star is halved again and again, and each half keeps those of the whole's candidates that its box meets and, where it is a narrow part of a
/// star of many neighbours, no plane parts from it. So a star of a thousand faces, each near few candidates, costs n log n, not n^2.
/// Keeps its memory, to allocate no more.
template <class Mesh>
class Star_runs {
public:
  using Coordinates = std::array<double, 3>;
  using Positions = std::vector<std::uint32_t>;

  /// Calls `visit(first, last, edges, vertices)` for runs [first, last) of faces, in their order, until it returns false; returns whether
  /// it never did. `edges` and `vertices` are positions in the list: all but those that certainly are not touched by the run's faces
  /// in the part of the motion that is of interest. The visitor may shorten the motion.
  template <class Visit>
  bool for_each_run(const Star<Mesh>& star, const Checklist<Mesh>& list, Star_motion& motion, const Visit& visit) {
    place(star, list, motion);
    return halve({star, list, motion}, 0, star.valence(), 0, visit);
  }

private:
  struct Near {
    Positions edges, vertices;
  };
  struct Scene {
    const Star<Mesh>& star;
    const Checklist<Mesh>& list;
    Star_motion& motion;
  };

  std::vector<Near> near_;               ///< by how often the star has been halved
  std::vector<Vector> spokes_, places_;  ///< of a star of many neighbours: link and candidate vertices, from where the motion starts
  double reach_ = 0;                     ///< of their coordinates; 0 where there are none

  static constexpr std::size_t few_faces = 3;             ///< no more are a run
  static constexpr std::size_t few_faces_of_a_wedge = 8;  ///< the same where planes are tried, too, which cost more than boxes
  /// Stars of more neighbours than this are worth planes between their parts and the candidates.
  static constexpr std::size_t many_neighbours = 16;

  template <class Visit>
  bool halve(const Scene& scene, std::size_t first, std::size_t last, std::size_t depth, const Visit& visit) {
    if (near_.size() <= depth)
      near_.resize(depth + 1);
    const Star<Mesh>& star = scene.star;
    Box_3 box = scene.motion.path();
    for (std::size_t i = first; i < last; ++i)
      box.include(star.link_points[i]);
    box.include(star.link_points[star.next(last - 1)]);
    near_[depth].edges.clear();
    near_[depth].vertices.clear();
    // All of a star, or half of it, is no wedge that planes at its ends could part from anything.
    const bool is_wedge = reach_ > 0 && 4 * (last - first) <= star.valence();
    const Swept_fan fan = is_wedge ? Swept_fan(scene.motion.way(), spokes_, first, last, reach_) : Swept_fan();
    const auto keep_edge = [&](std::uint32_t e) {
      const auto& edge = scene.list.edges()[e];
      if (do_meet(edge.box, box) && !(is_wedge && fan.is_apart(places_[edge.vertices[0]], places_[edge.vertices[1]])))
        near_[depth].edges.push_back(e);
    };
    const auto keep_vertex = [&](std::uint32_t v) {
      if (contains(box, scene.list.vertices()[v].point) && !(is_wedge && fan.is_apart(places_[v])))
        near_[depth].vertices.push_back(v);
    };
    if (depth == 0) {
      for (std::uint32_t e = 0; e < scene.list.edges().size(); ++e)
        keep_edge(e);
      for (std::uint32_t v = 0; v < scene.list.vertices().size(); ++v)
        keep_vertex(v);
    } else {
      for (const std::uint32_t e : near_[depth - 1].edges)
        keep_edge(e);
      for (const std::uint32_t v : near_[depth - 1].vertices)
        keep_vertex(v);
    }
    if (last - first <= (is_wedge ? few_faces_of_a_wedge : few_faces))
      return visit(first, last, near_[depth].edges, near_[depth].vertices);
    const std::size_t middle = first + (last - first) / 2;
    return halve(scene, first, middle, depth + 1, visit) && halve(scene, middle, last, depth + 1, visit);
  }

  /// Fills spokes_ and places_ for a star of many neighbours.
  void place(const Star<Mesh>& star, const Checklist<Mesh>& list, const Star_motion& motion) {
    reach_ = 0;
    if (star.valence() <= many_neighbours)
      return;
    reach_ = largest_magnitude(minus(motion.target(), motion.source()));
    const auto from_source = [&](const Coordinates& p) {
      const Vector place = minus(p, motion.source());
      reach_ = std::fmax(reach_, largest_magnitude(place));
      return place;
    };
    spokes_.clear();
    for (const Coordinates& p : star.link_points)
      spokes_.push_back(from_source(p));
    places_.clear();
    for (const auto& vertex : list.vertices())
      places_.push_back(from_source(vertex.point));
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
