// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Part_runner.h>
#include <haptic_sculpt/surface/broad_phase/Eight_flags.h>
#include <haptic_sculpt/surface/broad_phase/outward_float.h>

#include <vector>

namespace haptic_sculpt::internal {

/// The boxes of eight children, bound by bound, so that compilers compare four or eight at once. Three cache lines.
struct alignas(64) Box_node {
  static constexpr unsigned width = 8;

  float bounds[6][width]; ///< lower x, y, z; upper x, y, z

  /// Eight boxes of nothing.
  Box_node() {
    for (unsigned j = 0; j < width; ++j)
      set(j, Float_box());
  }

  void set(unsigned j, const Float_box& box) {
    for (int i = 0; i < 3; ++i)
      bounds[i][j] = box.lower[i], bounds[i + 3][j] = box.upper[i];
  }

  Float_box box(unsigned j) const {
    Float_box result;
    for (int i = 0; i < 3; ++i)
      result.lower[i] = bounds[i][j], result.upper[i] = bounds[i + 3][j];
    return result;
  }

  bool is(unsigned j, const Float_box& box) const {
    bool same = true;
    for (int i = 0; i < 3; ++i)
      same &= int(bounds[i][j] == box.lower[i]) & int(bounds[i + 3][j] == box.upper[i]);
    return same;
  }

  /// The smallest box around all eight. Halves, so that the first step of each bound is one instruction.
  Float_box all() const {
    Float_box result;
    for (int i = 0; i < 3; ++i) {
      float low[4], high[4];
      for (int j = 0; j < 4; ++j) {
        const float *l = bounds[i], *u = bounds[i + 3];
        low[j] = l[j] < l[j + 4] ? l[j] : l[j + 4];
        high[j] = u[j] > u[j + 4] ? u[j] : u[j + 4];
      }
      for (int j = 0; j < 2; ++j) {
        low[j] = low[j] < low[j + 2] ? low[j] : low[j + 2];
        high[j] = high[j] > high[j + 2] ? high[j] : high[j + 2];
      }
      result.lower[i] = low[0] < low[1] ? low[0] : low[1];
      result.upper[i] = high[0] > high[1] ? high[0] : high[1];
    }
    return result;
  }

  /// Bit j: whether box j meets the query.
  unsigned meeting(const Float_box& query) const {
    const auto is_apart_on = [&](int i) {
      return Eight_flags::greater(bounds[i], query.upper[i]) | Eight_flags::greater(query.lower[i], bounds[i + 3]);
    };
    return (is_apart_on(0) | is_apart_on(1) | is_apart_on(2)).where_not();
  }
};

/// Brings all nodes of an implicit tree up to date with those of its lowest level.
/// \param level_begin where each level begins among the nodes, the lowest first: it is the last of them
template <class Allocator>
void refit_all(std::vector<Box_node, Allocator>& nodes, const std::uint32_t* level_begin, int levels,
               const Part_runner& run = Part_runner()) {
  constexpr std::size_t nodes_a_part = 1024;
  for (int level = 1; level < levels; ++level) {
    const std::size_t begin = level_begin[level], below = level_begin[level - 1];
    const std::size_t below_end = level > 1 ? level_begin[level - 2] : nodes.size();
    run.in_ranges(below - begin, nodes_a_part, [&](std::size_t first, std::size_t end) {
      for (std::size_t k = first * Box_node::width; k < end * Box_node::width && below + k < below_end; ++k)
        nodes[begin + k / Box_node::width].set(k % Box_node::width, nodes[below + k].all());
    });
  }
}

} // namespace haptic_sculpt::internal
