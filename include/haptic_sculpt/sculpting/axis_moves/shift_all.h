// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Edit_result.h>
#include <haptic_sculpt/sculpting/Invalid_parameter.h>
#include <haptic_sculpt/sculpting/contact/check_arguments.h>
#include <haptic_sculpt/sculpting/axis_moves/Axis_move.h>
#include <haptic_sculpt/sculpting/axis_moves/Faces_on_the_way.h>
#include <haptic_sculpt/surface/coordinate_range.h>

#include <algorithm>

namespace haptic_sculpt::internal {

/// Whole ways or none. \throw Invalid_parameter, Unknown_vertex, Out_of_range, Mesh_changed
template <class Guarded, class Mesh = std::decay_t<decltype(std::declval<Guarded&>().mesh())>>
Edit_result<Mesh> shift_all(Guarded& guarded, int axis, Axis_ways<Mesh> ways, const Part_runner& run) {
  using Vertex_index = typename Mesh::Vertex_index;
  const Rounding_to_nearest rounding;
  if (axis < 0 || axis > 2)
    throw Invalid_parameter("the axis of a shift must be 0, 1 or 2, not " + std::to_string(axis));
  std::reverse(ways.begin(), ways.end());
  std::stable_sort(ways.begin(), ways.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  ways.erase(std::unique(ways.begin(), ways.end(), [](const auto& a, const auto& b) { return a.first == b.first; }),
             ways.end());
  Vertex_targets<Mesh> targets;
  targets.reserve(ways.size());
  for (const auto& [v, end] : ways) {
    check_vertex(guarded.mesh(), v);
    targets.emplace_back(v, vertex_coordinates(guarded.mesh(), v));
    targets.back().second[axis] = end;
    if (!is_in_range(end))
      throw_out_of_range("where vertex " + std::to_string(static_cast<std::size_t>(v)) + " is to go",
                         targets.back().second);
  }
  ways.erase(std::remove_if(
                 ways.begin(), ways.end(), // what is there already: no vertex that was moved
                 [&](const auto& way) { return vertex_coordinates(guarded.mesh(), way.first)[axis] == way.second; }),
             ways.end());
  guarded.look_around(targets);
  if (!guarded.shift(axis, ways, 0, run)) {
    const Axis_obstacle& first = guarded.obstacles_to(axis, ways, run).front();
    const bool is_of_face = first.size() == 3;
    auto refused = Edit_result<Mesh>::refused(is_of_face ? Refusal_reason::delta : Refusal_reason::blocked);
    for (int k = 0; k < first.size(); ++k)
      refused.refusal->elements.push_back(Vertex_index(first.vertices[k]));
    return refused;
  }
  return ways.empty() ? Edit_result<Mesh>{} : Edit_result<Mesh>::done(ways.back().first);
}

} // namespace haptic_sculpt::internal
