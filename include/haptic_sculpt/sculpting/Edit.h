// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace haptic_sculpt {

/// What is done.
enum class Edit_kind : std::uint8_t {
  none,           ///< nothing; where edits follow one another in time, the end of a tick
  move,           ///< drags the first of `vertices` to `legs`, one after the other, and to `point`
  insert_on_face, ///< creates a vertex at `point` on the face of `vertices`
  insert_on_edge, ///< creates a vertex at `point` on the edge of the first two
  remove,         ///< the first, into the neighbour that serves best
  collapse,       ///< draws the first into the second
  flip,           ///< of the edge of the first two
  shift,          ///< moves many along `axis`, all at once
  undo,
  redo,
  stroke, ///< what follows is one step of undo, ...
  end     ///< ... until here
};

/// An edit by value: to be kept, queued, written down, and made by `Sculptor::apply()`. Vertices are numbers that last
/// (`Sculptor::id()`). As apply() gives it back it is certain to be done again where it was done, without a bound on
/// work.
struct Edit {
  Edit_kind kind = Edit_kind::none;      ///< what is done
  std::array<std::size_t, 3> vertices{}; ///< those that the kind names; of the end of a tick, its number first
  std::array<double, 3> point{};         ///< where a vertex is created, or a move leads
  std::vector<std::array<double, 3>> legs;          ///< of a move, before `point`; mostly none
  int axis = 0;                                     ///< of a shift: 0, 1 or 2
  std::vector<std::pair<std::size_t, double>> ways; ///< of a shift: a vertex, and its coordinate along the axis then

  /// An edit of elements.
  static Edit of(Edit_kind kind, const std::array<std::size_t, 3>& vertices = {},
                 const std::array<double, 3>& point = {}) {
    Edit edit;
    edit.kind = kind, edit.vertices = vertices, edit.point = point;
    return edit;
  }
};

} // namespace haptic_sculpt
