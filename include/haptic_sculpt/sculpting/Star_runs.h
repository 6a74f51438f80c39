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
  using Sides = Places::Sides;

private:
  struct Edge {
    std::array<std::uint32_t, 2> ends; ///< which of the places
    std::uint32_t position;            ///< in the checklist
  };
  /// Candidates that are near some faces.
  struct Near {
    std::vector<Edge> edges;
    Places places;
    std::vector<std::uint32_t> positions; ///< of the places' vertices, in the checklist
  };

public:
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
      for (const Edge& edge : near_->edges) {
        const Sides sides = sides_of(edge);
        if ((sides & beyond_all_) != 0)
          continue;
        unsigned spokes = 0;
        for (std::size_t i = first; i < last; ++i)
          spokes |= ((sides & planes_->beyond_edge(i)) == 0 ? 1u : 0u) << (i - first);
        spokes &= ~(spoke_to(near_->positions[edge.ends[0]]) | spoke_to(near_->positions[edge.ends[1]]));
        for (; spokes != 0; spokes &= spokes - 1)
          if (!visit(first + lowest_bit(spokes), edge.position))
            return false;
      }
      return true;
    }
    /// The same for `visit(face, vertex)`, pairs of a moving face and a candidate vertex.
    template <class Visit>
    bool for_each_vertex_pair(const Visit& visit) const {
      for (std::size_t k = 0; k < near_->positions.size(); ++k) {
        const Sides sides = near_->places.sides(k);
        if ((sides & beyond_all_) != 0)
          continue;
        const std::uint32_t v = near_->positions[k];
        unsigned faces = 0;
        for (std::size_t i = first; i < last; ++i)
          faces |= ((sides & planes_->beyond_face(i)) == 0 ? 1u : 0u) << (i - first);
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
        const Places& places = near_->places; // of all vertices of the list, in its order
        if ((places.sides(a) & places.sides(b) & places.sides(c) & planes_->beyond_vertex()) == 0 && !visit(f))
          return false;
      }
      return true;
    }

    /// Calls `visit(edge)` for the candidates that the moving edge i may touch.
    template <class Visit>
    void for_each_edge_near(std::size_t i, const Visit& visit) const {
      for (const Edge& edge : near_->edges)
        if ((sides_of(edge) & planes_->beyond_edge(i)) == 0 && near_->positions[edge.ends[0]] != i &&
            near_->positions[edge.ends[1]] != i)
          visit(edge.position);
    }
    /// Calls `visit(vertex)` for the candidates that the moving face i may touch.
    template <class Visit>
    void for_each_vertex_near(std::size_t i, const Visit& visit) const {
      for (std::size_t k = 0; k < near_->positions.size(); ++k)
        if ((near_->places.sides(k) & planes_->beyond_face(i)) == 0 &&
            (faces_at(near_->positions[k]) >> (i - first) & 1) == 0)
          visit(near_->positions[k]);
    }

  private:
    friend class Star_runs;
    const Checklist<Mesh>* list_;
    const Near* near_;
    const Separating_planes* planes_;
    Sides beyond_all_;
    std::size_t valence_;

    Sides sides_of(const Edge& edge) const {
      return near_->places.sides(edge.ends[0]) & near_->places.sides(edge.ends[1]);
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
    const Scene scene{star, list, motion, margin};
    return star.valence() <= Separating_planes::most_faces ? visit(run(scene, 0, star.valence(), near_[0]))
                                                           : halve(scene, 0, star.valence(), 0, visit);
  }

private:
  struct Scene {
    const Star<Mesh>& star;
    const Checklist<Mesh>& list;
    Star_motion& motion;
    double margin;
  };

  std::vector<Near> near_ = std::vector<Near>(1); ///< by how often the star has been halved
  std::vector<Vector> spokes_;                    ///< from where the motion starts, like all places
  double reach_ = 0;                              ///< of the coordinates of spokes and places
  Separating_planes planes_;
  struct Copy {
    std::uint32_t round = 0, place = 0;
  };
  std::vector<Copy> copies_; ///< when a place was copied last, and where to
  std::uint32_t round_ = 0;

  /// Of a large star so many faces are a run.
  static constexpr std::size_t few_faces = 8;

  Run run(const Scene& scene, std::size_t first, std::size_t last, Near& near) {
    planes_.assign(scene.motion.way(), spokes_, first, last, reach_, scene.margin, box_of(scene, first, last));
    planes_.compare(near.places);
    Run result;
    result.first = first, result.last = last;
    result.valence_ = scene.star.valence();
    result.is_whole = last - first == result.valence_;
    result.list_ = &scene.list;
    result.near_ = &near, result.planes_ = &planes_;
    result.beyond_all_ = ~Sides{0};
    for (std::size_t i = first; i < last; ++i)
      result.beyond_all_ &= planes_.beyond_edge(i) & planes_.beyond_face(i);
    return result;
  }

  template <class Visit>
  bool halve(const Scene& scene, std::size_t first, std::size_t last, std::size_t depth, const Visit& visit) {
    if (last - first <= few_faces)
      return visit(run(scene, first, last, near_[depth]));
    const std::size_t middle = first + (last - first) / 2;
    if (!is_wedge(scene, last - middle))
      return halve(scene, first, middle, depth, visit) && halve(scene, middle, last, depth, visit);
    // What is beyond the other end of a half of a wedge has been left out before.
    const bool was_wedge = depth > 0;
    keep_near(scene, first, middle, depth, {!was_wedge, true});
    if (!halve(scene, first, middle, depth + 1, visit))
      return false;
    keep_near(scene, middle, last, depth, {true, !was_wedge});
    return halve(scene, middle, last, depth + 1, visit);
  }

  /// Half of a star is no wedge: hardly anything is apart from it.
  static bool is_wedge(const Scene& scene, std::size_t faces) { return 4 * faces <= scene.star.valence() + 3; }

  /// Copies those of the candidates kept at this depth that are near these faces to the next.
  /// \param ends whether to look for those beyond the first and the last spoke
  void keep_near(const Scene& scene, std::size_t first, std::size_t last, std::size_t depth, std::array<bool, 2> ends) {
    if (near_.size() <= depth + 1)
      near_.resize(depth + 2);
    Near &from = near_[depth], &near = near_[depth + 1];
    from.places.compare(box_of(scene, first, last));
    Swept_fan(scene.motion.way(), spokes_, first, last, reach_, scene.margin, ends).compare(from.places);
    // Whatever is near another time, nothing is allocated then. Each edge is written behind the last one, and counted if
    // it is near: no branch, which would be a guess.
    near.edges.resize(from.edges.size());
    std::size_t count = 0;
    for (const Edge& edge : from.edges) {
      near.edges[count] = edge;
      count += (from.places.sides(edge.ends[0]) & from.places.sides(edge.ends[1])) == 0;
    }
    near.edges.resize(count);
    near.places.reserve(from.places.size()), near.positions.reserve(from.places.size());
    near.places.clear(), near.positions.clear();
    if (copies_.size() < from.places.size() || ++round_ == 0) {
      copies_.assign(std::max(copies_.size(), from.places.size()), Copy{});
      round_ = 1;
    }
    const auto copied = [&](std::uint32_t place) {
      Copy& copy = copies_[place];
      if (copy.round != round_) {
        copy = {round_, static_cast<std::uint32_t>(near.positions.size())};
        near.places.push_back(from.places[place]);
        near.positions.push_back(from.positions[place]);
      }
      return copy.place;
    };
    for (Edge& edge : near.edges)
      edge.ends = {copied(edge.ends[0]), copied(edge.ends[1])};
    // As a rule a vertex that is near is an end of edges that are; but a list may have vertices without edges.
    for (std::uint32_t place = 0; place < from.places.size(); ++place)
      if (from.places.sides(place) == 0)
        copied(place);
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
    Near& all = near_[0];
    all.places.clear();
    all.positions.resize(list.vertices().size());
    for (std::size_t v = 0; v < all.positions.size(); ++v) {
      all.places.push_back(from_source(list.vertices()[v].point));
      all.positions[v] = static_cast<std::uint32_t>(v);
    }
    all.edges.resize(list.edges().size());
    for (std::size_t e = 0; e < all.edges.size(); ++e)
      all.edges[e] = {list.edges()[e], static_cast<std::uint32_t>(e)};
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
