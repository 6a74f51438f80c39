// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_NEAR_CANDIDATES_H
#define HAPTIC_SCULPT_SCULPTING_NEAR_CANDIDATES_H

#include <haptic_sculpt/sculpting/Checklist.h>
#include <haptic_sculpt/sculpting/Diagonal_box.h>

#include <cstdint>
#include <vector>

namespace haptic_sculpt {
namespace internal {

/// Finds, for a few neighbouring faces of a star at a time, the edges and vertices of a checklist near them.
///
/// The faces are halved until few are left, and each half is compared with what was near the whole: a star of a
/// thousand faces, each near few candidates, costs n log n that way, not n^2. Keeps its memory.
template <class Mesh>
class Near_candidates {
public:
  using Positions = std::vector<std::uint32_t>;

  /// Calls `leaf(first, last, edges, vertices)` for groups of faces of the star, those from link[first] to link[last],
  /// with positions in the checklist: all that may be no more than `margin` (rounded) from the hull of where the centre
  /// is, `moving` and `diagonals`, and these faces' link vertices. Ends when it returns false, and returns whether it
  /// never did.
  template <class Leaf>
  bool for_each_group(const Star<Mesh>& star, const Checklist<Mesh>& list, const Box_3& moving,
                      const Diagonal_box& diagonals, double margin, const Leaf& leaf) {
    return halve(Search{star, list, moving, diagonals, margin,
                        star.valence() > usual_valence || list.edges().size() > usual_edges},
                 0, star.valence(), 0, leaf);
  }

private:
  /// So many faces are compared with the candidates one by one; more are halved first.
  static constexpr std::size_t few_faces = 3;
  /// Where the star has more faces than this, or there are more edges, groups are compared along the diagonals too.
  static constexpr std::size_t usual_valence = 12, usual_edges = 256;

  struct Near {
    Positions edges, vertices;
  };
  struct Search {
    const Star<Mesh>& star;
    const Checklist<Mesh>& list;
    const Box_3& moving;
    const Diagonal_box& diagonals;
    double margin;
    bool is_large;
  };

  std::vector<Near> near_; ///< by depth

  template <class Leaf>
  bool halve(const Search& search, std::size_t first, std::size_t last, std::size_t depth, const Leaf& leaf) {
    if (near_.size() <= depth)
      near_.resize(depth + 1);
    Box_3 box = search.moving;
    Diagonal_box diagonals = search.diagonals;
    const auto include = [&](const Box_3::Coordinates& p) {
      box.include(p);
      if (search.is_large)
        diagonals.include(p);
    };
    for (std::size_t i = first; i < last; ++i)
      include(search.star.link_points[i]);
    include(search.star.link_points[search.star.next(last - 1)]);
    diagonals.inflate(search.margin);
    if (search.margin > 0)
      for (int i = 0; i < 3; ++i)
        box.lower[i] -= search.margin, box.upper[i] += search.margin;
    const auto& edges = search.list.edges();
    const auto& vertices = search.list.vertices();
    Near& near = near_[depth];
    near.edges.clear();
    near.vertices.clear();
    near.edges.reserve(edges.size()); // whatever is near another time, nothing is allocated then
    near.vertices.reserve(vertices.size());
    const auto keep_edge = [&](std::uint32_t e) {
      if (do_meet(edges[e].box, box) && !(search.is_large && diagonals.excludes(vertices[edges[e].vertices[0]].point,
                                                                                vertices[edges[e].vertices[1]].point)))
        near.edges.push_back(e);
    };
    const auto keep_vertex = [&](std::uint32_t v) {
      if (contains(box, vertices[v].point) && !(search.is_large && diagonals.excludes(vertices[v].point)))
        near.vertices.push_back(v);
    };
    if (depth == 0) {
      for (std::uint32_t e = 0; e < edges.size(); ++e)
        keep_edge(e);
      for (std::uint32_t v = 0; v < vertices.size(); ++v)
        keep_vertex(v);
    } else {
      for (const std::uint32_t e : near_[depth - 1].edges)
        keep_edge(e);
      for (const std::uint32_t v : near_[depth - 1].vertices)
        keep_vertex(v);
    }
    if (last - first <= few_faces)
      return leaf(first, last, near.edges, near.vertices);
    const std::size_t middle = first + (last - first) / 2;
    return halve(search, first, middle, depth + 1, leaf) && halve(search, middle, last, depth + 1, leaf);
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
