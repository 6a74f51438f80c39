// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_AXIS_BOX_TREE_H
#define HAPTIC_SCULPT_SCULPTING_AXIS_BOX_TREE_H

#include <haptic_sculpt/sculpting/axis_moves/Axis_box.h>
#include <haptic_sculpt/surface/broad_phase/bits.h>

#include <algorithm>
#include <vector>

namespace haptic_sculpt {
namespace internal {

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
  }

  /// From here on nothing is active.
  void begin_round() {
    for (std::uint32_t node : active_)
      for (auto& level : levels_) {
        level[node].is_active = 0;
        node /= width;
      }
    active_.clear();
  }

  void set(std::uint32_t slot, const Axis_box& box, bool is_active) {
    const std::uint32_t number = slot / width;
    Axis_box_node& node = levels_[0][number];
    node.set(slot % width, box);
    if (is_active)
      node.is_active = static_cast<std::uint8_t>(node.is_active | 1u << slot % width);
    if (touched_.empty() || touched_.back() != number)
      touched_.push_back(number);
    if (is_active && (active_.empty() || active_.back() != number))
      active_.push_back(number);
  }

  /// Calls `found(a, b)` for each pair of slots of which one is active and whose boxes may meet; a != b, each pair
  /// once. Ends where it returns false.
  template <class Found>
  void for_each_pair(const Found& found) {
    refit();
    join_itself(static_cast<int>(levels_.size()) - 1, 0, found);
  }

  /// Bytes held, capacity included.
  std::size_t memory() const {
    std::size_t nodes = 0;
    for (const auto& level : levels_)
      nodes += level.capacity();
    return nodes * sizeof(Axis_box_node) + (touched_.capacity() + active_.capacity()) * sizeof(std::uint32_t);
  }

private:
  static constexpr std::uint32_t width = Axis_box_node::width;

  std::vector<std::vector<Axis_box_node>> levels_; ///< the lowest first
  std::vector<std::uint32_t> touched_;             ///< nodes of the lowest level that have been set and not refitted
  std::vector<std::uint32_t> active_;              ///< those with an active child

  void refit() {
    for (std::size_t level = 1; level < levels_.size(); ++level) {
      std::sort(touched_.begin(), touched_.end());
      touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
      std::size_t count = 0;
      for (std::size_t k = 0; k < touched_.size(); ++k) {
        const std::uint32_t child = touched_[k], number = child / width;
        const Axis_box_node& below = levels_[level - 1][child];
        Axis_box_node& node = levels_[level][number];
        node.set(child % width, below.all());
        if (below.is_active != 0)
          node.is_active = static_cast<std::uint8_t>(node.is_active | 1u << child % width);
        if (count == 0 || touched_[count - 1] != number)
          touched_[count++] = number;
      }
      touched_.resize(count);
    }
    touched_.clear();
  }

  /// These return false where `found` has.
  template <class Found>
  bool join_itself(int level, std::uint32_t number, const Found& found) const {
    const Axis_box_node& node = levels_[level][number];
    if (node.is_active == 0)
      return true;
    for (unsigned i = 0; i < width; ++i) {
      if ((node.is_there >> i & 1) == 0)
        continue;
      if (level > 0 && !join_itself(level - 1, number * width + i, found))
        return false;
      unsigned mask = node.meeting(node.box(i)) & ~((2u << i) - 1);
      if ((node.is_active >> i & 1) == 0)
        mask &= node.is_active;
      if (!visit(level, number * width + i, number * width, mask, found))
        return false;
    }
    return true;
  }

  template <class Found>
  bool join(int level, std::uint32_t a, std::uint32_t b, const Found& found) const {
    const Axis_box_node &node = levels_[level][a], &other = levels_[level][b];
    for (unsigned i = 0; i < width; ++i) {
      if ((node.is_there >> i & 1) == 0)
        continue;
      unsigned mask = other.meeting(node.box(i));
      if ((node.is_active >> i & 1) == 0)
        mask &= other.is_active;
      if (!visit(level, a * width + i, b * width, mask, found))
        return false;
    }
    return true;
  }

  template <class Found>
  bool visit(int level, std::uint32_t child, std::uint32_t first, unsigned mask, const Found& found) const {
    for (; mask != 0; mask &= mask - 1) {
      const std::uint32_t other = first + lowest_bit(mask);
      if (!(level == 0 ? found(child, other) : join(level - 1, child, other, found)))
        return false;
    }
    return true;
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
