// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_STAR_RUNS_H
#define HAPTIC_SCULPT_SCULPTING_STAR_RUNS_H

#include <haptic_sculpt/sculpting/Checklist.h>
#include <haptic_sculpt/sculpting/Diagonal_box.h>
#include <haptic_sculpt/sculpting/Star_motion.h>
#include <haptic_sculpt/sculpting/Swept_fan.h>

namespace haptic_sculpt {
namespace internal {

/// Goes through the faces of a star in runs of a few, each with the candidates that are near it.
///
/// The star is halved again and again, and each half keeps those of the whole's candidates that its box meets and,
/// where there are many, that are not apart from it along a diagonal; or, where it is a narrow part of a star of many
/// neighbours, that no plane parts from it. So a star of a thousand faces, each near few candidates, costs n log n, not
/// n^2. Keeps its memory, to allocate no more.
template <class Mesh>
class Star_runs {
public:
  using Coordinates = std::array<double, 3>;
  using Positions = std::vector<std::uint32_t>;

  /// Calls `visit(first, last, edges, vertices)` for runs [first, last) of faces, in their order, until it returns
  /// false; returns whether it never did. `edges` and `vertices` are positions in the list: all but those that
  /// certainly are not touched by the run's faces in the part of the motion that is of interest, or are then farther
  /// than `margin` (rounded) from them. The visitor may shorten the motion.
  template <class Visit>
  bool for_each_run(const Star<Mesh>& star, const Checklist<Mesh>& list, Star_motion& motion, double margin,
                    const Visit& visit) {
    place(star, list, motion);
    const bool is_large = star.valence() > usual_valence || list.edges().size() > usual_edges;
    return halve({star, list, motion, margin, is_large}, 0, star.valence(), 0, visit);
  }

private:
  struct Near {
    Positions edges, vertices;
  };
  struct Scene {
    const Star<Mesh>& star;
    const Checklist<Mesh>& list;
    Star_motion& motion;
    double margin;
    bool is_large;
  };

  std::vector<Near> near_; ///< by how often the star has been halved
  std::vector<Vector> spokes_,
      places_;       ///< of a star of many neighbours: link and candidate vertices, from where the motion starts
  double reach_ = 0; ///< of their coordinates; 0 where there are none

  static constexpr std::size_t few_faces = 3; ///< no more are a run
  static constexpr std::size_t few_faces_of_a_wedge =
      8; ///< the same where planes are tried, too, which cost more than boxes
  /// Stars of more neighbours than this are worth planes between their parts and the candidates.
  static constexpr std::size_t many_neighbours = 16;
  /// Where the star has more faces than this, or there are more edges, diagonals are compared.
  static constexpr std::size_t usual_valence = 12, usual_edges = 256;

  template <class Visit>
  bool halve(const Scene& scene, std::size_t first, std::size_t last, std::size_t depth, const Visit& visit) {
    if (near_.size() <= depth)
      near_.resize(depth + 1);
    const Star<Mesh>& star = scene.star;
    const auto& all_edges = scene.list.edges();
    const auto& all_vertices = scene.list.vertices();
    // All of a star, or half of it, is no wedge that planes at its ends could part from anything.
    const bool is_wedge = reach_ > 0 && 4 * (last - first) <= star.valence(),
               has_diagonals = scene.is_large && !is_wedge;
    Box_3 box = scene.motion.path();
    Diagonal_box diagonals(scene.motion.source(), scene.motion.target());
    for (std::size_t i = first; i <= last; ++i) {
      const Coordinates& p = star.link_points[i < star.valence() ? i : 0];
      box.include(p);
      if (has_diagonals)
        diagonals.include(p);
    }
    if (scene.margin > 0) {
      diagonals.inflate(scene.margin);
      for (int i = 0; i < 3; ++i)
        box.lower[i] -= scene.margin, box.upper[i] += scene.margin;
    }
    const Swept_fan fan =
        is_wedge ? Swept_fan(scene.motion.way(), spokes_, first, last, reach_, scene.margin) : Swept_fan();
    Near& near = near_[depth];
    near.edges.clear();
    near.vertices.clear();
    near.edges.reserve(all_edges.size()); // whatever is near another time, nothing is allocated then
    near.vertices.reserve(all_vertices.size());
    const auto keep_edge = [&](std::uint32_t e) {
      const auto& [a, b] = all_edges[e].vertices;
      if (do_meet(all_edges[e].box, box) && !(is_wedge && fan.is_apart(places_[a], places_[b])) &&
          !(has_diagonals && diagonals.excludes(all_vertices[a].point, all_vertices[b].point)))
        near.edges.push_back(e);
    };
    const auto keep_vertex = [&](std::uint32_t v) {
      if (contains(box, all_vertices[v].point) && !(is_wedge && fan.is_apart(places_[v])) &&
          !(has_diagonals && diagonals.excludes(all_vertices[v].point)))
        near.vertices.push_back(v);
    };
    if (depth == 0) {
      for (std::uint32_t e = 0; e < all_edges.size(); ++e)
        keep_edge(e);
      for (std::uint32_t v = 0; v < all_vertices.size(); ++v)
        keep_vertex(v);
    } else {
      for (const std::uint32_t e : near_[depth - 1].edges)
        keep_edge(e);
      for (const std::uint32_t v : near_[depth - 1].vertices)
        keep_vertex(v);
    }
    if (last - first <= (is_wedge ? few_faces_of_a_wedge : few_faces))
      return visit(first, last, near.edges, near.vertices);
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
