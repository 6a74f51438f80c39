// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/culling/Candidate_list.h>
#include <haptic_sculpt/sculpting/culling/Separating_planes.h>
#include <haptic_sculpt/sculpting/culling/Spoke_planes.h>
#include <haptic_sculpt/surface/broad_phase/processor.h>

namespace haptic_sculpt::internal {

/// Candidates that are near some faces of a star.
struct Near_candidates {
  struct Edge {
    std::array<std::uint32_t, 2> ends; ///< which of the points
    std::uint32_t position;            ///< in the list of candidates
  };
  std::vector<Edge> edges;
  Outcodes outcodes;
  std::vector<std::uint32_t> positions; ///< of the points' vertices, in the list of candidates

  void reserve(std::size_t most_points, std::size_t most_edges) {
    edges.reserve(most_edges);
    outcodes.reserve(most_points);
    positions.reserve(most_points);
  }
};

/// Faces [first, last) of a star and the candidates near them: pairs of a moving and a still feature that may touch,
/// and do not share a vertex.
template <class Mesh>
class Star_run {
public:
  using Outcode = Outcodes::Outcode;
  using Edge = Near_candidates::Edge;

  std::size_t first, last;
  bool is_whole; ///< these are all faces of the star

  /// Faces of a star that is not large. \pre planes are about them, and have found the sides of the candidates
  Star_run(const Candidate_list<Mesh>& list, std::size_t valence, const Near_candidates& near, std::size_t first,
           std::size_t last, const Separating_planes& planes)
      : Star_run(list, valence, near, first, last, &planes) {
    beyond_all_ = ~Outcode{0};
    for (std::size_t i = first; i < last; ++i)
      beyond_all_ &= planes.beyond_edge(i) & planes.beyond_face(i);
  }
  /// A narrow part of a large star. \pre planes at its spokes have found the sides of the candidates
  Star_run(const Candidate_list<Mesh>& list, std::size_t valence, const Near_candidates& near, std::size_t first,
           std::size_t last)
      : Star_run(list, valence, near, first, last, nullptr) {}

  /// Calls `visit(spoke, edge)` for all pairs of a moving edge, by its place in the link, and a candidate, by its
  /// position in the list, until it returns false; returns whether it never did.
  template <class Visit>
  bool for_each_edge_pair(const Visit& visit) const {
    for (const Edge& edge : near_->edges) {
      unsigned spokes = spokes_near(sides_of(edge));
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
      const std::uint32_t v = near_->positions[k];
      for (unsigned faces = faces_near(near_->outcodes.outcode(k)) & ~faces_at(v); faces != 0; faces &= faces - 1)
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
      const Outcodes& outcodes = near_->outcodes; // of all vertices of the list, in its order
      if ((outcodes.outcode(a) & outcodes.outcode(b) & outcodes.outcode(c) & planes_->beyond_vertex()) == 0 &&
          !visit(f))
        return false;
    }
    return true;
  }

  /// Calls `visit(edge)` for the candidates that the moving edge i may touch.
  template <class Visit>
  void for_each_edge_near(std::size_t i, const Visit& visit) const {
    for (const Edge& edge : near_->edges)
      if ((spokes_near(sides_of(edge)) >> (i - first) & 1) != 0 && near_->positions[edge.ends[0]] != i &&
          near_->positions[edge.ends[1]] != i)
        visit(edge.position);
  }
  /// Calls `visit(vertex)` for the candidates that the moving face i may touch.
  template <class Visit>
  void for_each_vertex_near(std::size_t i, const Visit& visit) const {
    for (std::size_t k = 0; k < near_->positions.size(); ++k)
      if (((faces_near(near_->outcodes.outcode(k)) & ~faces_at(near_->positions[k])) >> (i - first) & 1) != 0)
        visit(near_->positions[k]);
  }

private:
  const Candidate_list<Mesh>* list_;
  std::size_t valence_;
  const Near_candidates* near_;
  const Separating_planes* planes_; ///< none in a large star
  Outcode beyond_all_ = 0;            ///< beyond all that these faces sweep over

  Star_run(const Candidate_list<Mesh>& list, std::size_t valence, const Near_candidates& near, std::size_t first,
           std::size_t last, const Separating_planes* planes)
      : first(first)
      , last(last)
      , is_whole(last - first == valence)
      , list_(&list)
      , valence_(valence)
      , near_(&near)
      , planes_(planes) {}

  Outcode sides_of(const Edge& edge) const {
    return near_->outcodes.outcode(edge.ends[0]) & near_->outcodes.outcode(edge.ends[1]);
  }

  /// The bits of the spokes that what lies on these sides may touch.
  unsigned spokes_near(Outcode sides) const {
    return planes_ == nullptr ? all() & ~Spoke_planes::apart_from_spokes(sides)
                              : near(sides, [this](std::size_t i) { return planes_->beyond_edge(i); });
  }
  /// The same of the faces.
  unsigned faces_near(Outcode sides) const {
    return planes_ == nullptr ? all() & ~Spoke_planes::apart_from_faces(sides)
                              : near(sides, [this](std::size_t i) { return planes_->beyond_face(i); });
  }
  template <class Beyond>
  unsigned near(Outcode sides, const Beyond& beyond) const {
    if ((sides & beyond_all_) != 0)
      return 0;
    unsigned result = 0;
    for (std::size_t i = first; i < last; ++i)
      result |= ((sides & beyond(i)) == 0 ? 1u : 0u) << (i - first);
    return result;
  }
  unsigned all() const { return (1u << (last - first)) - 1; }

  // The first vertices of a list are those of the link, in its order.
  /// The bit of the spoke that ends in this vertex, if any.
  unsigned spoke_to(std::size_t v) const { return v >= first && v < last ? 1u << (v - first) : 0; }
  /// The bits of the faces that have this vertex.
  unsigned faces_at(std::size_t v) const {
    const std::size_t before = v != 0 ? v - 1 : valence_ - 1;
    return v < valence_ ? spoke_to(v) | spoke_to(before) : 0;
  }
};

} // namespace haptic_sculpt::internal
