// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_STAR_RUNS_H
#define HAPTIC_SCULPT_SCULPTING_STAR_RUNS_H

#include <haptic_sculpt/sculpting/Checklist.h>
#include <haptic_sculpt/sculpting/Separating_planes.h>
#include <haptic_sculpt/sculpting/Star_motion.h>
#include <haptic_sculpt/surface/bits.h>

namespace haptic_sculpt {
namespace internal {

/// Goes through the faces of a star in runs of a few, each with the candidates that are near it.
///
/// A star of usual valence is one run. A larger one is halved again and again, and each half keeps those of the whole's
/// candidates that its box meets and, where it is a narrow part, that no plane parts from it. So a star of a thousand
/// faces, each near few candidates, costs n log n, not n^2. Keeps its memory, to allocate no more.
template <class Mesh>
class Star_runs {
public:
  using Coordinates = std::array<double, 3>;
  using Positions = std::vector<std::uint32_t>;
  using Sides = Separating_planes::Sides;

  /// Faces [first, last) of a star and the candidates near them: pairs of a moving and a still feature that may touch,
  /// and do not share a vertex.
  class Run {
  public:
    std::size_t first, last;
    bool is_whole; ///< these are all faces of the star

    /// Calls `visit(spoke, edge)` for all pairs of a moving edge, by its place in the link, and a candidate, by its
    /// position in the list, until it returns false; returns whether it never did.
    template <class Visit>
    bool for_each_edge_pair(const Visit& visit) const {
      for (const std::uint32_t e : *edges_) {
        const Sides sides = sides_of(e);
        if ((sides & beyond_all_) != 0)
          continue;
        unsigned spokes = 0;
        for (std::size_t k = 0; k < last - first; ++k)
          spokes |= ((sides & planes_->beyond_edge(first + k)) == 0 ? 1u : 0u) << k;
        const auto& [a, b] = list_->edges()[e];
        for (spokes &= ~(spoke_to(a) | spoke_to(b)); spokes != 0; spokes &= spokes - 1)
          if (!visit(first + lowest_bit(spokes), e))
            return false;
      }
      return true;
    }
    /// The same for `visit(face, vertex)`, pairs of a moving face and a candidate vertex.
    template <class Visit>
    bool for_each_vertex_pair(const Visit& visit) const {
      for (const std::uint32_t v : *vertices_) {
        const Sides sides = (*sides_)[v];
        if ((sides & beyond_all_) != 0)
          continue;
        unsigned faces = 0;
        for (std::size_t k = 0; k < last - first; ++k)
          faces |= ((sides & planes_->beyond_face(first + k)) == 0 ? 1u : 0u) << k;
        for (faces &= ~faces_at(v); faces != 0; faces &= faces - 1)
          if (!visit(first + lowest_bit(faces), v))
            return false;
      }
      return true;
    }
    /// The same for `visit(candidate)`, faces that the moving vertex may touch. \pre is_whole
    template <class Visit>
    bool for_each_face(const Visit& visit) const {
      const auto& faces = list_->faces();
      for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const auto& [a, b, c] = faces[f].vertices;
        if (((*sides_)[a] & (*sides_)[b] & (*sides_)[c] & planes_->beyond_vertex()) == 0 && !visit(f))
          return false;
      }
      return true;
    }

    /// Calls `visit(edge)` for the candidates that the moving edge i may touch.
    template <class Visit>
    void for_each_edge_near(std::size_t i, const Visit& visit) const {
      for (const std::uint32_t e : *edges_)
        if ((sides_of(e) & planes_->beyond_edge(i)) == 0 && list_->edges()[e][0] != i && list_->edges()[e][1] != i)
          visit(e);
    }
    /// Calls `visit(vertex)` for the candidates that the moving face i may touch.
    template <class Visit>
    void for_each_vertex_near(std::size_t i, const Visit& visit) const {
      for (const std::uint32_t v : *vertices_)
        if (((*sides_)[v] & planes_->beyond_face(i)) == 0 && (faces_at(v) >> (i - first) & 1) == 0)
          visit(v);
    }

  private:
    friend class Star_runs;
    const Checklist<Mesh>* list_;
    const Positions *edges_, *vertices_;
    const std::vector<Sides>* sides_;
    const Separating_planes* planes_;
    Sides beyond_all_;
    std::size_t valence_;

    Sides sides_of(std::uint32_t e) const {
      const auto& [a, b] = list_->edges()[e];
      return (*sides_)[a] & (*sides_)[b];
    }

    // The first vertices of a list are those of the link, in its order.
    /// The bit of the spoke that ends in this vertex, if any.
    unsigned spoke_to(std::size_t v) const { return v >= first && v < last ? 1u << (v - first) : 0; }
    /// The bits of the faces that have this vertex.
    unsigned faces_at(std::size_t v) const {
      const std::size_t before = v != 0 ? v - 1 : valence_ - 1;
      return v < valence_ ? spoke_to(v) | spoke_to(before) : 0;
    }
  };

  /// Calls `visit(run)` until it returns false; returns whether it never did. In no run are pairs that certainly do not
  /// touch in the part of the motion that is of interest, and are then farther than `margin` (rounded) from each other;
  /// of those that may, none is left out. The visitor may shorten the motion.
  template <class Visit>
  bool for_each_run(const Star<Mesh>& star, const Checklist<Mesh>& list, Star_motion& motion, double margin,
                    const Visit& visit) {
    place(star, list, motion);
    if (near_.empty())
      near_.resize(1);
    Near& all = near_[0];
    count_up(all.edges, list.edges().size());
    count_up(all.vertices, list.vertices().size());
    const Scene scene{star, list, motion, margin};
    if (star.valence() <= Separating_planes::most_faces)
      return visit(run(scene, 0, star.valence(), all));
    all.corners = all.vertices;
    sides_.assign(list.vertices().size(), 0);
    return halve(scene, 0, star.valence(), 1, visit);
  }

private:
  struct Near {
    Positions edges, vertices;
    Positions corners; ///< the vertices, and those of the edges
  };
  struct Scene {
    const Star<Mesh>& star;
    const Checklist<Mesh>& list;
    Star_motion& motion;
    double margin;
  };

  std::vector<Near> near_; ///< by how often the star has been halved
  std::vector<Vector> spokes_;
  Places places_; ///< of link and candidate vertices, from where the motion starts
  double reach_ = 0; ///< of their coordinates
  std::vector<Sides> sides_; ///< of the candidate vertices
  Places near_places_;       ///< those near a run of a large star
  std::vector<Sides> near_sides_;
  Separating_planes planes_;
  std::vector<std::uint32_t> seen_; ///< when a candidate vertex was taken last
  std::uint32_t round_ = 0;

  /// Of a large star so many faces are a run.
  static constexpr std::size_t few_faces = 8;

  Run run(const Scene& scene, std::size_t first, std::size_t last, const Near& near) {
    planes_.assign(scene.motion.way(), spokes_, first, last, reach_, scene.margin, box_of(scene, first, last));
    if (last - first == scene.star.valence()) {
      planes_.sides_of(places_, sides_);
    } else {
      near_places_.clear();
      for (const std::uint32_t v : near.corners)
        near_places_.push_back({places_.of[0][v], places_.of[1][v], places_.of[2][v]});
      planes_.sides_of(near_places_, near_sides_);
      for (std::size_t k = 0; k < near.corners.size(); ++k)
        sides_[near.corners[k]] = near_sides_[k];
    }
    Run result;
    result.first = first, result.last = last;
    result.valence_ = scene.star.valence();
    result.is_whole = last - first == result.valence_;
    result.list_ = &scene.list;
    result.edges_ = &near.edges, result.vertices_ = &near.vertices;
    result.sides_ = &sides_, result.planes_ = &planes_;
    result.beyond_all_ = ~Sides{0};
    for (std::size_t i = first; i < last; ++i)
      result.beyond_all_ &= planes_.beyond_edge(i) & planes_.beyond_face(i);
    return result;
  }

  template <class Visit>
  bool halve(const Scene& scene, std::size_t first, std::size_t last, std::size_t depth, const Visit& visit) {
    keep_near(scene, first, last, depth);
    if (last - first <= few_faces) {
      return visit(run(scene, first, last, near_[depth]));
    }
    const std::size_t middle = first + (last - first) / 2;
    return halve(scene, first, middle, depth + 1, visit) && halve(scene, middle, last, depth + 1, visit);
  }

  /// Those of the candidates kept at the depth before that are near these faces.
  void keep_near(const Scene& scene, std::size_t first, std::size_t last, std::size_t depth) {
    if (near_.size() <= depth)
      near_.resize(depth + 1);
    const auto& edges = scene.list.edges();
    const Near& from = near_[depth - 1];
    Near& near = near_[depth];
    // Whatever is near another time, nothing is allocated then.
    near.edges.reserve(edges.size()), near.edges.clear();
    near.vertices.reserve(places_.size()), near.vertices.clear();
    near.corners.reserve(places_.size()), near.corners.clear();
    const Box_3 box = box_of(scene, first, last);
    // All of a star, or half of it, is no wedge that planes at its ends could part from anything.
    const Swept_fan fan = 4 * (last - first) <= scene.star.valence()
                              ? Swept_fan(scene.motion.way(), spokes_, first, last, reach_, scene.margin)
                              : Swept_fan();
    for (const std::uint32_t v : from.corners) {
      const Vector p = {places_.of[0][v], places_.of[1][v], places_.of[2][v]};
      unsigned sides = fan.sides_of(p);
      for (int i = 0; i < 3; ++i)
        sides |= (p[i] > box.upper[i] ? 16u : 0u) << 2 * i | (p[i] < box.lower[i] ? 32u : 0u) << 2 * i;
      sides_[v] = sides;
    }
    seen_.resize(std::max(seen_.size(), places_.size()));
    ++round_;
    const auto take = [&](std::uint32_t v) {
      if (seen_[v] != round_)
        near.corners.push_back(v);
      seen_[v] = round_;
    };
    for (const std::uint32_t e : from.edges)
      if ((sides_[edges[e][0]] & sides_[edges[e][1]]) == 0) {
        near.edges.push_back(e);
        take(edges[e][0]), take(edges[e][1]);
      }
    for (const std::uint32_t v : from.vertices)
      if (sides_[v] == 0) {
        near.vertices.push_back(v);
        take(v);
      }
  }

  /// Around what these faces sweep over, in coordinates from the start of the motion. Rounded like those of the
  /// candidates, so comparisons with them lose nothing: differences grow with what is subtracted from, in any rounding
  /// mode.
  Box_3 box_of(const Scene& scene, std::size_t first, std::size_t last) const {
    Box_3 box = scene.motion.path();
    for (std::size_t i = first; i <= last; ++i)
      box.include(scene.star.link_points[i < scene.star.valence() ? i : 0]);
    const Coordinates& start = scene.motion.source();
    for (int i = 0; i < 3; ++i) {
      box.lower[i] = box.lower[i] - scene.margin - start[i];
      box.upper[i] = box.upper[i] + scene.margin - start[i];
    }
    return box;
  }

  static void count_up(Positions& positions, std::size_t size) {
    positions.resize(size);
    for (std::size_t i = 0; i < size; ++i)
      positions[i] = static_cast<std::uint32_t>(i);
  }

  void place(const Star<Mesh>& star, const Checklist<Mesh>& list, const Star_motion& motion) {
    reach_ = quick_magnitude(minus(motion.target(), motion.source()));
    const auto from_source = [&](const Coordinates& p) {
      const Vector place = minus(p, motion.source());
      reach_ = larger(reach_, quick_magnitude(place));
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
