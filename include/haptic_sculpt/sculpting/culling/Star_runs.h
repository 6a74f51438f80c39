// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/culling/Star_run.h>
#include <haptic_sculpt/sculpting/geometry/Star_motion.h>

namespace haptic_sculpt::internal {

/// Goes through the faces of a star in runs of a few, each with the candidates that are near it.
///
/// A star of usual valence is one run, of up to twice as much two. A larger one is divided into narrow parts, and these
/// again, and each part keeps those of the whole's candidates that no plane parts from it. So a star of a thousand
/// faces, each near few candidates, costs n log n, not n^2. Keeps its memory, to allocate no more.
template <class Mesh>
class Star_runs {
public:
  using Coordinates = std::array<double, 3>;
  using Run = Star_run<Mesh>;

  /// Calls `visit(run)` until it returns false; returns whether it never did. In no run are pairs that certainly do not
  /// touch in the part of the motion that is of interest, and are then farther than `margin` (rounded) from each other;
  /// of those that may, none is left out. The visitor may shorten the motion. \pre it does not keep the run, nor ask
  /// for other runs meanwhile: they share their memory
  template <class Visit>
  bool for_each_run(const Star<Mesh>& star, const Candidate_list<Mesh>& list, Star_motion& motion, double margin,
                    const Visit& visit) {
    place(star, list, motion);
    const Scene scene{star, list, motion, margin};
    const std::size_t valence = star.valence(), half = valence / 2;
    constexpr std::size_t most = Separating_planes::most_faces;
    if (valence <= most)
      return visit(run_of_few(scene, 0, valence));
    if (valence <= most_undivided)
      return visit(run_of_few(scene, 0, half)) && visit(run_of_few(scene, half, valence));
    return divide(scene, 0, valence, 0, visit);
  }

  /// Stars of up to this many faces are not divided.
  static constexpr std::size_t most_undivided = 2 * Separating_planes::most_faces;

  /// Makes room for stars of at most this many faces, and this many candidates.
  void reserve(std::size_t valence, std::size_t vertices, std::size_t edges) {
    spokes_.reserve(valence);
    levels_[0].near.reserve(vertices, edges);
    if (valence <= most_undivided)
      return;
    for (std::size_t depth = 0, faces = valence; faces > most_faces; ++depth) {
      const std::size_t parts = parts_of(faces, depth);
      make_level(depth + 1, vertices, edges);
      for (std::size_t part = 0; part < parts; ++part)
        levels_[depth].parts[part].make_room(vertices, edges);
      faces = (faces + parts - 1) / parts;
    }
    spoke_planes_.reserve(vertices);
  }

private:
  struct Scene {
    const Star<Mesh>& star;
    const Candidate_list<Mesh>& list;
    Star_motion& motion;
    double margin;
  };

  /// The candidates near some faces that are divided into parts, and which of them are near each part.
  struct Level {
    Near_candidates near;
    struct Part {
      std::vector<std::uint32_t> edges, points; ///< which of near's, as many as are counted
      std::size_t number_of_edges, number_of_points;

      void make_room(std::size_t most_points, std::size_t most_edges) {
        edges.resize(std::max(edges.size(), most_edges));
        points.resize(std::max(points.size(), most_points));
      }
    };
    std::array<Part, Swept_fan::most_fans> parts;
  };

  std::vector<Level> levels_ = std::vector<Level>(1); ///< by how often the star has been divided
  std::vector<Vector> spokes_;                        ///< from where the motion starts, like all points
  double reach_ = 0;                                  ///< of the coordinates of spokes and points
  double unit_ =
      1; ///< a power of two, by which all of these are multiplied where products of them might leave the range
  Separating_planes planes_;
  Spoke_planes spoke_planes_;
  static constexpr std::uint32_t nowhere = 0xffffffff;
  std::vector<std::uint32_t> kept_;   ///< the points that are copied
  std::vector<std::uint32_t> copies_; ///< where to; nowhere for all others

  /// Of a run.
  static constexpr std::size_t most_faces = std::min(Separating_planes::most_faces, Spoke_planes::most_faces);
  /// A large star is divided into this many parts at least: hardly anything is apart from a third of a star.
  static constexpr std::size_t least_parts = 4;
  /// Into this many where there are more runs than parts can be: more take more planes, fewer more divisions.
  static constexpr std::size_t usual_parts = 8;

  /// Faces of a star that is not large, or on a long way.
  Run run_of_few(const Scene& scene, std::size_t first, std::size_t last, std::size_t depth = 0) {
    Near_candidates& near = levels_[depth].near;
    planes_.assign(way_of(scene), spokes_, first, last, reach_, scene.margin * unit_, box_of(scene, first, last));
    planes_.compare(near.outcodes);
    return Run(scene.list, scene.star.valence(), near, first, last, planes_);
  }
  /// A narrow part of a large star.
  Run run_of_many(const Scene& scene, std::size_t first, std::size_t last, std::size_t depth) {
    Near_candidates& near = levels_[depth].near;
    spoke_planes_.assign(way_of(scene), spokes_, first, last, reach_, scene.margin * unit_);
    spoke_planes_.compare(near.outcodes);
    return Run(scene.list, scene.star.valence(), near, first, last);
  }

  /// Parts are made as even as possible, and parts of them, until each is a run.
  template <class Visit>
  bool divide(const Scene& scene, std::size_t first, std::size_t last, std::size_t depth, const Visit& visit) {
    const std::size_t faces = last - first;
    if (faces <= most_faces)
      return visit(is_long(scene, first) ? run_of_few(scene, first, last, depth)
                                         : run_of_many(scene, first, last, depth));
    const std::size_t parts = parts_of(faces, depth);
    const auto begin = [&](std::size_t part) { return first + faces * part / parts; };
    find_near(scene, parts, begin, depth);
    for (std::size_t part = 0; part < parts; ++part) {
      keep_near(part, depth);
      if (!divide(scene, begin(part), begin(part + 1), depth + 1, visit))
        return false;
    }
    return true;
  }

  /// Into how many parts faces are divided. \pre they are more than a run has
  static std::size_t parts_of(std::size_t faces, std::size_t depth) {
    const std::size_t runs = (faces + most_faces - 1) / most_faces;
    return runs > Swept_fan::most_fans ? usual_parts : depth == 0 ? std::max(least_parts, runs) : runs;
  }

  /// Makes room to copy candidates to this depth.
  void make_level(std::size_t depth, std::size_t points, std::size_t edges) {
    if (levels_.size() <= depth)
      levels_.resize(depth + 1);
    levels_[depth].near.reserve(points, edges);
    kept_.reserve(points);
    if (copies_.size() < points)
      copies_.resize(points, nowhere);
  }

  /// Whether the motion is longer than a spoke: what is swept over is a cone then, which planes to its tip fit best.
  bool is_long(const Scene& scene, std::size_t spoke) const {
    return quick_magnitude(way_of(scene)) > quick_magnitude(spokes_[spoke]);
  }

  /// Finds which of the candidates kept at this depth are near which part.
  template <class Begin>
  void find_near(const Scene& scene, std::size_t parts, const Begin& begin, std::size_t depth) {
    Level& level = levels_[depth];
    Outcodes& outcodes = level.near.outcodes;
    const auto& edges = level.near.edges;
    outcodes.clear();
    for (std::size_t k = 0; k < parts; ++k) {
      // What is beyond the ends of a part has been left out before.
      const std::array<bool, 2> ends = {depth == 0 || k > 0, depth == 0 || k + 1 < parts};
      Swept_fan(way_of(scene), spokes_, begin(k), begin(k + 1), reach_, scene.margin * unit_, ends)
          .compare(outcodes, k);
      typename Level::Part& part = level.parts[k];
      part.make_room(outcodes.size(), edges.size());
      part.number_of_edges = part.number_of_points = 0;
    }
    const unsigned all = (1u << parts) - 1;
    for (std::uint32_t v = 0; v < outcodes.size(); ++v)
      for (unsigned near = all & ~Swept_fan::apart_from_fans(outcodes.outcode(v)); near != 0; near &= near - 1) {
        typename Level::Part& part = level.parts[lowest_bit(near)];
        part.points[part.number_of_points++] = v;
      }
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      const Outcodes::Outcode sides = outcodes.outcode(edges[e].ends[0]) & outcodes.outcode(edges[e].ends[1]);
      for (unsigned near = all & ~Swept_fan::apart_from_fans(sides); near != 0; near &= near - 1) {
        typename Level::Part& part = level.parts[lowest_bit(near)];
        part.edges[part.number_of_edges++] = e;
      }
    }
  }

  /// Copies the candidates near this part to the next depth.
  void keep_near(std::size_t which, std::size_t depth) {
    // Whatever is near another time, nothing is allocated then.
    make_level(depth + 1, levels_[depth].near.outcodes.size(), levels_[depth].near.edges.size());
    const Near_candidates& from = levels_[depth].near;
    Near_candidates& near = levels_[depth + 1].near;
    const typename Level::Part& part = levels_[depth].parts[which];
    kept_.assign(part.points.begin(), part.points.begin() + part.number_of_points);
    for (std::uint32_t k = 0; k < kept_.size(); ++k)
      copies_[kept_[k]] = k;
    // As a rule an edge that is near has ends that are, but not each.
    const auto copied = [&](std::uint32_t place) {
      if (copies_[place] == nowhere) {
        copies_[place] = static_cast<std::uint32_t>(kept_.size());
        kept_.push_back(place);
      }
      return copies_[place];
    };
    near.edges.resize(part.number_of_edges);
    for (std::size_t k = 0; k < part.number_of_edges; ++k) {
      const auto& edge = from.edges[part.edges[k]];
      near.edges[k] = {{copied(edge.ends[0]), copied(edge.ends[1])}, edge.position};
    }
    near.outcodes.assign(from.outcodes, kept_);
    near.positions.resize(kept_.size());
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      near.positions[k] = from.positions[kept_[k]];
      copies_[kept_[k]] = nowhere;
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
      box.lower[i] = (box.lower[i] - scene.margin - start[i]) * unit_;
      box.upper[i] = (box.upper[i] + scene.margin - start[i]) * unit_;
    }
    return box;
  }

  Vector way_of(const Scene& scene) const { return scene.motion.way(unit_); }

  void place(const Star<Mesh>& star, const Candidate_list<Mesh>& list, const Star_motion& motion) {
    reach_ = quick_magnitude(minus(motion.target(), motion.source()));
    const auto from_source = [&](const Coordinates& p) {
      const Vector place = minus(p, motion.source());
      reach_ = larger(reach_, quick_magnitude(place));
      return place;
    };
    spokes_.clear();
    for (const Coordinates& p : star.link_points)
      spokes_.push_back(from_source(p));
    Near_candidates& all = levels_[0].near;
    all.outcodes.resize(list.vertices().size());
    all.positions.resize(list.vertices().size());
    for (std::size_t v = 0; v < all.positions.size(); ++v) {
      all.outcodes.set(v, from_source(list.vertices()[v].point));
      all.positions[v] = static_cast<std::uint32_t>(v);
    }
    unit_ = Outcodes::serve(reach_) ? 1 : unit_of(reach_);
    if (unit_ != 1) {
      reach_ *= unit_;
      all.outcodes.scale(unit_);
      for (Vector& spoke : spokes_)
        spoke = scaled(spoke, unit_);
    }
    all.edges.resize(list.edges().size());
    for (std::size_t e = 0; e < all.edges.size(); ++e)
      all.edges[e] = {list.edges()[e], static_cast<std::uint32_t>(e)};
  }
};

} // namespace haptic_sculpt::internal
