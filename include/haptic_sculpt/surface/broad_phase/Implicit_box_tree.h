// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/broad_phase/nearest_first.h>
#include <haptic_sculpt/surface/broad_phase/processor.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace haptic_sculpt::internal {

/// A laid-out 8-wide tree of boxes over slots, each of which holds an item, a number, or nothing. Node k of a level has
/// the children 8k ... 8k + 7 of the level below, and those of the lowest level are the slots: no pointers.
class Implicit_box_tree {
public:
  static constexpr std::uint32_t width = Box_node::width, none = ~std::uint32_t{0};

  Implicit_box_tree() { touched_.reserve(most_touched + 1); }

  /// A slot for each of `size` items, in order. Cost: linear.
  /// \param item_of `item_of(slot)` \param box_of `box_of(item)`
  template <class Item_of, class Box_of>
  void build(std::size_t size, const Item_of& item_of, const Box_of& box_of) {
    if (size == 0)
      return;
    const std::size_t slots = size;
    std::array<std::uint32_t, most_levels> sizes{};
    do
      size = sizes[levels_++] = static_cast<std::uint32_t>((size + width - 1) / width);
    while (size > 1);
    std::uint32_t begin = 0;
    for (int level = levels_ - 1; level >= 0; --level)
      level_begin_[level] = begin, begin += sizes[level];
    nodes_.resize(begin);
    items_.assign(std::size_t{sizes[0]} * width, none);
    for (std::size_t slot = 0; slot < slots; ++slot)
      items_[slot] = item_of(slot);
    set_all(box_of, Part_runner());
  }

  std::size_t number_of_nodes() const { return nodes_.size(); }
  /// What is in a slot; `none` where that is nothing.
  std::uint32_t& item(std::size_t slot) { return items_[slot]; }
  /// A free slot in the node of this one; `none` where there is none.
  std::uint32_t free_slot_beside(std::uint32_t slot) const {
    const auto begin = items_.begin() + slot / width * width, found = std::find(begin, begin + width, none);
    return found != begin + width ? static_cast<std::uint32_t>(found - items_.begin()) : none;
  }

  /// \name Changing boxes: the boxes above are brought up to date by refit()
  ///@{
  void begin_changes() { touched_.clear(); }
  /// Costs log n, with refit().
  void set(std::uint32_t slot, const Float_box& box) {
    if (touched_.size() == most_touched) {
      refit();
      touched_.clear();
    }
    touched_.push_back(0);
    touched_.resize(set(0, slot, box, touched_.size() - 1));
  }
  void refit() {
    for (int level = 1; level < levels_ && !touched_.empty(); ++level) {
      std::size_t count = 0; // nodes of this level are written over those of the level below that have been read
      for (std::size_t k = 0; k < touched_.size(); ++k)
        count = set(level, touched_[k], nodes_[level_begin_[level - 1] + touched_[k]].all(), count);
      touched_.resize(count);
    }
  }
  /// For many at once: refit_all() has to follow.
  void set_without_noting(std::uint32_t slot, const Float_box& box) { lowest(slot / width).set(slot % width, box); }
  void refit_all(const Part_runner& run = Part_runner()) {
    internal::refit_all(nodes_, level_begin_.data(), levels_, run);
  }
  /// Those of all items, and all above. \param box_of `box_of(item)`, by several threads
  template <class Box_of>
  void set_all(const Box_of& box_of, const Part_runner& run) {
    run.in_ranges(items_.size(), slots_a_part, [&](std::size_t first, std::size_t end) {
      for (std::size_t slot = first; slot < end; ++slot)
        if (items_[slot] != none)
          lowest(slot / width).set(slot % width, box_of(items_[slot]));
    });
    refit_all(run);
  }
  ///@}

  /// Visits the items whose boxes pass, `passing(node)` being a mask of eight, until `visit(item)` has been called for
  /// all those of a node and `is_enough()`. Returns whether all were visited.
  template <class Passing, class Visit, class Is_enough>
  bool visit(const Passing& passing, const Visit& visit_item, const Is_enough& is_enough) {
    to_root();
    return visit_below(passing, visit_item, is_enough);
  }

  /// Visits items as Box_tree_broad_phase does. Returns the last limit.
  template <class Bound, class Visit>
  double visit_nearest_first(const Bound& bound, double limit, const Visit& visit_item) {
    nearest_.clear();
    if (levels_ != 0)
      nearest_.push({-std::numeric_limits<double>::infinity(), 0, levels_ - 1});
    for (Nearest_first_stack::Entry next; nearest_.pop(limit, next);) {
      const std::uint32_t first = next.number * width;
      const int level = next.level;
      const Box_node& node = nodes_[level_begin_[level] + next.number];
      if (level == 0) {
        limit = Nearest_first_stack::visit_items(
            node, bound, limit, [&](unsigned j) { return items_[first + j]; }, visit_item);
        continue;
      }
      nearest_.push_children(node, level - 1, bound, limit, [&](unsigned j) {
        prefetch(&nodes_[level_begin_[level - 1] + first + j], sizeof(Box_node));
        if (level == 1)
          prefetch(&items_[std::size_t{first + j} * width], width * sizeof(std::uint32_t));
        return first + j;
      });
    }
    return limit;
  }

  /// Begins to fetch from memory what a visit of what meets this will read. Cost: log n.
  void fetch_ahead(const Float_box& box) {
    if (levels_ == 0 || level_begin_[0] < nodes_in_cache)
      return;
    ahead_ = box;
    to_root();
    while (is_worth_fetching() && level_begin_[level_ - 1] < nodes_in_cache)
      fetch_on();
  }
  /// Goes on with that for a level, whose nodes have come by now.
  void fetch_on() {
    if (is_worth_fetching())
      go_down([this](const Box_node& node) { return node.meeting(ahead_); }, end_);
  }

  /// Whatever is visited or set allocates nothing from here on.
  void reserve() {
    nearest_.reserve(std::size_t{width} * (most_levels + 1));
    if (queue_.size() < largest_queue)
      queue_.resize(largest_queue);
  }

  /// Bytes held, capacity included.
  std::size_t memory() const {
    return nodes_.capacity() * sizeof(Box_node) +
           (items_.capacity() + touched_.capacity() + queue_.capacity()) * sizeof(std::uint32_t) + nearest_.memory();
  }

private:
  static constexpr int most_levels = 11; ///< 8^11 > 2^31
  /// Levels that begin before this node, at 192 KiB, are taken to be in cache. With more nodes on a level than
  /// most_ahead nothing is fetched: what was guessed is much too large.
  static constexpr std::uint32_t nodes_in_cache = 1024, most_ahead = 64;
  static constexpr std::size_t most_at_once = 128; ///< nodes of a level, in a visit
  /// Of a visit at most, each portion's children on every level.
  static constexpr std::size_t largest_queue = std::size_t{most_levels} * width * most_at_once + width;
  static constexpr std::size_t slots_a_part = 1024 * width; ///< that threads work on; no two share a node
  static constexpr std::size_t most_touched = 256; ///< before they are refitted: there is room for this many

  std::vector<Box_node> nodes_;                          ///< level by level from the root
  std::array<std::uint32_t, most_levels> level_begin_{}; ///< of the lowest level first; the last is the root's, 0
  int levels_ = 0;
  std::vector<std::uint32_t> items_;   ///< eight for each node of the lowest level
  std::vector<std::uint32_t> touched_; ///< nodes of one level with a box that has changed
  std::vector<std::uint32_t> queue_;   ///< nodes that a visit goes through, level by level
  std::size_t begin_ = 0, end_ = 0;    ///< those of the level at hand
  int level_ = 0;                      ///< of which the nodes at hand are
  Float_box ahead_;                    ///< what is fetched ahead
  Nearest_first_stack nearest_;

  Box_node& lowest(std::size_t k) { return nodes_[level_begin_[0] + k]; }

  /// Sets the box of child `index` of a level. Where that changes anything notes its node behind the first `count`
  /// touched ones, unless it is among the last of them: the faces of a star share nodes. \return how many are noted
  std::size_t set(int level, std::uint32_t index, const Float_box& box, std::size_t count) {
    Box_node& node = nodes_[level_begin_[level] + index / width];
    if (node.is(index % width, box))
      return count;
    node.set(index % width, box);
    const std::size_t looked_at = std::min<std::size_t>(count, 8); // a node noted twice costs time only
    const auto end = touched_.begin() + count;
    if (std::find(end - looked_at, end, index / width) == end)
      touched_[count++] = index / width;
    return count;
  }

  /// What is below the nodes at hand, a portion of them after the other: the queue stays short, and where too much
  /// passes that is known before all nodes of a level have been read.
  template <class Passing, class Visit, class Is_enough>
  bool visit_below(const Passing& passing, const Visit& visit_item, const Is_enough& is_enough) {
    while (level_ > 0 && begin_ != end_) {
      const std::size_t end = end_, last = std::min(end, begin_ + most_at_once);
      const int level = level_;
      go_down(passing, last);
      if (last == end)
        continue;
      if (!visit_below(passing, visit_item, is_enough))
        return false;
      begin_ = last, end_ = end, level_ = level;
    }
    for (; begin_ != end_; ++begin_) {
      for (unsigned mask = passing(lowest(queue_[begin_])); mask != 0; mask &= mask - 1)
        visit_item(items_[std::size_t{queue_[begin_]} * width + lowest_bit(mask)]);
      if (is_enough())
        return false;
    }
    return true;
  }

  void to_root() {
    queue_.resize(std::max<std::size_t>(queue_.size(), 1));
    queue_[0] = 0;
    begin_ = 0, end_ = levels_ != 0 ? 1 : 0;
    level_ = levels_ - 1;
  }

  bool is_worth_fetching() const { return level_ > 0 && end_ - begin_ <= most_ahead; }

  /// Puts the children that pass of the nodes up to `last` behind all of them, and has them at hand.
  ///
  /// All are asked for before the first is read, so that memory is waited for once a level; on the way to one leaf
  /// after the other it would be waited for on each.
  template <class Passing>
  void go_down(const Passing& passing, std::size_t last) {
    const Box_node* const nodes = &nodes_[level_begin_[level_]];
    const Box_node* const children = &nodes_[level_begin_[level_ - 1]];
    std::size_t count = end_;
    for (; begin_ != last; ++begin_) {
      if (queue_.size() < count + width)
        queue_.resize(2 * (count + width));
      const std::uint32_t first = queue_[begin_] * width;
      for (unsigned mask = passing(nodes[queue_[begin_]]); mask != 0; mask &= mask - 1) {
        const std::uint32_t child = first + lowest_bit(mask);
        prefetch(children + child, sizeof(Box_node));
        if (level_ == 1)
          prefetch(&items_[std::size_t{child} * width], width * sizeof(std::uint32_t));
        queue_[count++] = child;
      }
    }
    begin_ = end_, end_ = count;
    --level_;
  }
};

} // namespace haptic_sculpt::internal
