// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/axis_sweep.h>
#include <haptic_sculpt/collision/arithmetic/unit_of.h>

#include <cmath>
#include <tuple>
#include <utility>

namespace haptic_sculpt::internal {

/// What makes a motion along an axis not free.
struct Axis_obstacle {
  enum class Kind : std::uint8_t {
    vertex_face, ///< vertex 0 meets the face 1, 2, 3
    edge_edge,   ///< edge 0, 1 meets edge 2, 3
    flat_face,   ///< the face 0, 1, 2 becomes degenerate
    delta        ///< the face 0, 1, 2 gets an altitude below delta
  };
  Kind kind;
  std::array<std::uint32_t, 4> vertices; ///< indices; of a face three, and the last is the first again

  int size() const { return kind == Kind::vertex_face || kind == Kind::edge_edge ? 4 : 3; }
  /// The same, whichever of two edges was found first.
  Axis_obstacle in_order() const {
    auto [a, b, c, d] = vertices;
    if (kind != Kind::edge_edge)
      return *this;
    if (b < a)
      std::swap(a, b);
    if (d < c)
      std::swap(c, d);
    if (std::make_pair(c, d) < std::make_pair(a, b))
      std::swap(a, c), std::swap(b, d);
    return {kind, {a, b, c, d}};
  }
  bool operator<(const Axis_obstacle& other) const {
    return std::tie(vertices, kind) < std::tie(other.vertices, other.kind);
  }
};

/// What share of their ways vertices may go so that a quarter of a gap is left.
struct Axis_pull {
  std::array<bool, 4> is_pulled; ///< those whose ways close the gap; the others may go all of theirs
  double share;                  ///< in [0, 1)
};

/// The height of one feature of a pair above the other is a sum of weighted heights of the four corners; the weights do
/// not change. Rounded, and only a proposal: what is made of it is decided again. Where nothing can be said, in
/// vertical planes, all go half their ways.
inline Axis_pull pull_for(Axis_obstacle::Kind kind, const Axis_motion<4>& motion) {
  Axis_pull pull{{true, true, true, true}, 0.5};
  constexpr int i = 0, j = 1, h = 2, end = 3;
  const auto& p = motion.places;
  double across = 0, along = 0; // the largest differences, lest products leave the range
  for (int k = 0; k < 4; ++k) {
    across = std::fmax(across, std::fmax(std::abs(p[k][i] - p[0][i]), std::abs(p[k][j] - p[0][j])));
    along = std::fmax(along, std::fmax(std::abs(p[k][h] - p[0][h]), std::abs(p[k][end] - p[k][h])));
  }
  const double unit_across = unit_of(across), unit_along = unit_of(along);
  // Each product-sum is a fused one, so that compilers cannot choose.
  const auto minor = [&](int a, int b, int c, int d) { // of b - a and d - c
    const double x = (p[b][i] - p[a][i]) * unit_across, y = (p[b][j] - p[a][j]) * unit_across;
    return std::fma(x, (p[d][j] - p[c][j]) * unit_across, -(y * ((p[d][i] - p[c][i]) * unit_across)));
  };
  std::array<double, 4> weights;
  if (kind == Axis_obstacle::Kind::vertex_face)
    weights = {minor(1, 2, 1, 3), -minor(0, 2, 0, 3), -minor(0, 3, 0, 1), -minor(0, 1, 0, 2)};
  else if (kind == Axis_obstacle::Kind::edge_edge) {
    const double all = minor(0, 1, 2, 3), at_first = minor(0, 2, 2, 3), at_second = minor(0, 2, 0, 1);
    weights = {all - at_first, at_first, at_second - all, -at_second};
  } else
    return pull;
  double gap = 0;
  for (int k = 1; k < 4; ++k)
    gap = std::fma(weights[k], (p[k][h] - p[0][h]) * unit_along, gap);
  double closing = 0, opening = 0;
  Axis_pull proposed = pull;
  for (int k = 0; k < 4; ++k) {
    const double change = std::copysign(1.0, gap) * weights[k] * ((p[k][end] - p[k][h]) * unit_along);
    proposed.is_pulled[k] = change < 0;
    (change < 0 ? closing : opening) += std::abs(change);
  }
  proposed.share = (0.75 * std::abs(gap) + opening) / closing;
  return proposed.share < 1 ? proposed : pull; // not where it is not a number either
}

} // namespace haptic_sculpt::internal
