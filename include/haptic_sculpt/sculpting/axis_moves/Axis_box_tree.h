// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Part_runner.h>
#include <haptic_sculpt/sculpting/axis_moves/Axis_box.h>
#include <haptic_sculpt/surface/broad_phase/processor.h>

#include <algorithm>
#include <vector>

namespace haptic_sculpt::internal {

/// An implicit 8-wide tree over slots, neighbours in space side by side, that finds the pairs of slots whose boxes may
/// meet in a motion along one axis.
///
/// Slots are set for the whole motion or a few again; the pairs asked for are those of which one is active, that is,
/// has been set as such since `begin_round()`. Cost: linear in what is set; of a search linear in the pairs found,
/// about.
class Axis_box_tree {
public:
  /// For this many slots, all empty.
  void resize(std::size_t slots) {
    levels_.clear();
    for (std::size_t size = slots; size > 1 || levels_.empty();) {
      size = std::max<std::size_t>(1, (size + width - 1) / width); // a root, even of nothing
      levels_.emplace_back(size);
    }
    touched_.clear();
    active_.clear();
    is_refitted_ = true;
  }

  /// From here on nothing is active.
  void begin_round() {
    if (!is_refitted_) // memory ran out, and `active_` lacks what was put
      for (auto& level : levels_)
        for (Axis_box_node& node : level)
          node.is_active = 0;
    for (std::uint32_t node : active_)
      for (auto& level : levels_) {
        level[node].is_active = 0;
        node /= width;
      }
    active_.clear();
    is_refitted_ = false;
  }

  void set(std::uint32_t slot, const Axis_box& box, bool is_active) {
    is_refitted_ = false;
    put(slot, box, is_active);
    const std::uint32_t number = slot / width;
    if (touched_.empty() || touched_.back() != number)
      touched_.push_back(number);
    if (is_active && (active_.empty() || active_.back() != number))
      active_.push_back(number);
  }

  /// As set(), of a slot that is not to be refitted by itself: refit_all() follows. Threads may share the slots, but
  /// not those of one node.
  void put(std::uint32_t slot, const Axis_box& box, bool is_active) {
    Axis_box_node& node = levels_[0][slot / width];
    node.set(slot % width, box);
    if (is_active)
      node.is_active = static_cast<std::uint8_t>(node.is_active | 1u << slot % width);
  }

  /// After all slots have been put.
  void refit_all(const Part_runner& run) {
    for (std::size_t level = 1; level < levels_.size(); ++level)
      run.in_ranges(levels_[level].size(), nodes_a_part, [&](std::size_t first, std::size_t end) {
        const auto& below = levels_[level - 1];
        for (std::size_t child = first * width; child < std::min(below.size(), end * width); ++child)
          adopt(levels_[level][child / width], child, below[child]);
      });
    touched_.clear();
    active_.clear();
    for (std::uint32_t number = 0; number < levels_[0].size(); ++number)
      if (levels_[0][number].is_active != 0)
        active_.push_back(number);
    is_refitted_ = true;
  }

  /// Brings the boxes above what has been set up to date.
  void refit() {
    for (std::size_t level = 1; level < levels_.size(); ++level) {
      std::sort(touched_.begin(), touched_.end());
      touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
      std::size_t count = 0;
      for (std::size_t k = 0; k < touched_.size(); ++k) {
        const std::uint32_t child = touched_[k], number = child / width;
        adopt(levels_[level][number], child, levels_[level - 1][child]);
        if (count == 0 || touched_[count - 1] != number)
          touched_[count++] = number;
      }
      touched_.resize(count);
    }
    touched_.clear();
    is_refitted_ = true;
  }

  /// Two nodes of a level, or one and itself, whose slots are to be looked at together.
  struct Join {
    int level;
    std::uint32_t a, b;
  };

  /// The search for all pairs, in joins small enough that threads can share them; always the same ones.
  /// \pre refit() or refit_all()
  const std::vector<Join>& joins() {
    joins_.clear();
    const int top = static_cast<int>(levels_.size()) - 1;
    const auto kept = [this](const Join& join) { joins_.push_back(join); };
    divide_itself(top, 0, std::min(top, level_of_joins), kept);
    return joins_;
  }

  /// Calls `found(a, b)` for each pair of slots of a join of which one is active and whose boxes may meet; a != b, each
  /// pair once in all joins.
  template <class Found>
  void for_each_pair(const Join& join, const Found& found) const {
    const auto each = [&found](const Join& slots) { found(slots.a, slots.b); };
    join.a == join.b ? divide_itself(join.level, join.a, -1, each) : divide(join.level, join.a, join.b, -1, each);
  }

  /// Bytes held, capacity included.
  std::size_t memory() const {
    std::size_t nodes = 0;
    for (const auto& level : levels_)
      nodes += level.capacity();
    return nodes * sizeof(Axis_box_node) + (touched_.capacity() + active_.capacity()) * sizeof(std::uint32_t) +
           joins_.capacity() * sizeof(Join);
  }

private:
  static constexpr std::uint32_t width = Axis_box_node::width;
  static constexpr int level_of_joins = 2;          ///< a node of this level has 512 slots
  static constexpr std::size_t nodes_a_part = 1024; ///< that threads work on

  std::vector<std::vector<Axis_box_node>> levels_; ///< the lowest first
  std::vector<std::uint32_t> touched_;             ///< nodes of the lowest level that have been set and not refitted
  std::vector<std::uint32_t> active_;              ///< those with an active child
  std::vector<Join> joins_;
  bool is_refitted_ = true; ///< since the last slot was put

  static void adopt(Axis_box_node& node, std::size_t child, const Axis_box_node& below) {
    node.set(child % width, below.all());
    if (below.is_active != 0)
      node.is_active = static_cast<std::uint8_t>(node.is_active | 1u << child % width);
  }

  /// Goes down to the joins of a level, which are kept; those of level -1 are pairs of slots, of which none is a slot
  /// and itself.
  template <class Kept>
  void divide_itself(int level, std::uint32_t number, int end, const Kept& kept) const {
    const Axis_box_node& node = levels_[level][number];
    if (node.is_active == 0)
      return;
    if (level == end)
      return kept(Join{level, number, number});
    for (unsigned i = 0; i < width; ++i) {
      if ((node.is_there >> i & 1) == 0)
        continue;
      if (level > 0)
        divide_itself(level - 1, number * width + i, end, kept);
      unsigned mask = node.meeting(node.box(i)) & ~((2u << i) - 1);
      if ((node.is_active >> i & 1) == 0)
        mask &= node.is_active;
      divide_children(level, number * width + i, number * width, mask, end, kept);
    }
  }

  template <class Kept>
  void divide(int level, std::uint32_t a, std::uint32_t b, int end, const Kept& kept) const {
    if (level == end)
      return kept(Join{level, a, b});
    const Axis_box_node &node = levels_[level][a], &other = levels_[level][b];
    for (unsigned i = 0; i < width; ++i) {
      if ((node.is_there >> i & 1) == 0)
        continue;
      unsigned mask = other.meeting(node.box(i));
      if ((node.is_active >> i & 1) == 0)
        mask &= other.is_active;
      divide_children(level, a * width + i, b * width, mask, end, kept);
    }
  }

  template <class Kept>
  void divide_children(int level, std::uint32_t child, std::uint32_t first, unsigned mask, int end,
                       const Kept& kept) const {
    for (; mask != 0; mask &= mask - 1)
      divide(level - 1, child, first + lowest_bit(mask), end, kept);
  }
};

} // namespace haptic_sculpt::internal
