// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_SHIFT_ALL_H
#define HAPTIC_SCULPT_SCULPTING_SHIFT_ALL_H

#include <haptic_sculpt/sculpting/Edit_result.h>
#include <haptic_sculpt/sculpting/Invalid_parameter.h>
#include <haptic_sculpt/sculpting/axis_moves/Axis_move.h>

#include <algorithm>

namespace haptic_sculpt {
namespace internal {

/// The way of functions that are no members to what a Sculptor guards.
struct Sculptor_access {
  template <class Sculptor>
  static auto& guarded(Sculptor& sculptor) {
    return sculptor.guarded_;
  }
};

/// Whole ways or none. \throw Invalid_parameter, and what Guarded_mesh::shift() throws
template <class Guarded, class Mesh = std::decay_t<decltype(std::declval<Guarded&>().mesh())>>
Edit_result<Mesh> shift_all(Guarded& guarded, int axis, Axis_ways<Mesh> ways) {
  using Vertex_index = typename Mesh::Vertex_index;
  if (axis < 0 || axis > 2)
    throw Invalid_parameter("the axis of a shift must be 0, 1 or 2, not " + std::to_string(axis));
  std::reverse(ways.begin(), ways.end());
  std::stable_sort(ways.begin(), ways.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  ways.erase(std::unique(ways.begin(), ways.end(), [](const auto& a, const auto& b) { return a.first == b.first; }),
             ways.end());
  Axis_move<Mesh> move = guarded.axis_move();
  if (!guarded.shift(move, axis, ways, 0)) {
    const Axis_obstacle& first = move.obstacles().front();
    const bool is_of_face = first.size() == 3;
    auto refused = Edit_result<Mesh>::refused(is_of_face ? Refusal_reason::delta : Refusal_reason::blocked);
    for (int k = 0; k < first.size(); ++k)
      refused.refusal->elements.push_back(Vertex_index(first.vertices[k]));
    return refused;
  }
  return ways.empty() ? Edit_result<Mesh>{} : Edit_result<Mesh>::done(ways.back().first);
}

} // namespace internal
} // namespace haptic_sculpt

#endif
