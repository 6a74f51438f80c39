// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/broad_phase/Box_node.h>
#include <haptic_sculpt/surface/broad_phase/processor.h>

#include <utility>
#include <vector>

namespace haptic_sculpt::internal {

/// The nodes that a search of a tree of boxes has found and not looked at yet. The nearest of those found last is on
/// top.
class Nearest_first_stack {
public:
  struct Entry {
    double bound;
    std::uint32_t number;
    int level;
  };

  void clear() { entries_.clear(); }
  void push(const Entry& entry) { entries_.push_back(entry); }

  /// Pushes the children of a node, the nearest last; children farther than `limit` and empty boxes are left out.
  /// \param bound `bound(node, lowest)` writes a lower bound for each of the eight boxes; returns the bits of those
  /// that count. \param number `number(j)` of child j
  template <class Bound, class Number>
  void push_children(const Box_node& node, int level, const Bound& bound, double limit, const Number& number) {
    alignas(64) double lowest[Box_node::width];
    const std::size_t first = entries_.size();
    for (unsigned mask = bound(node, lowest); mask != 0; mask &= mask - 1) {
      const unsigned j = lowest_bit(mask);
      if (lowest[j] > limit)
        continue;
      entries_.push_back({lowest[j], number(j), level});
      for (std::size_t k = entries_.size() - 1; k > first && entries_[k - 1].bound < entries_[k].bound; --k)
        std::swap(entries_[k - 1], entries_[k]);
    }
  }

  /// Visits the items of a lowest node that are not farther than the limit, `visit(item(j))` telling the next one.
  /// Returns the last.
  template <class Bound, class Item, class Visit>
  static double visit_items(const Box_node& node, const Bound& bound, double limit, const Item& item,
                            const Visit& visit) {
    alignas(64) double lowest[Box_node::width];
    for (unsigned mask = bound(node, lowest); mask != 0; mask &= mask - 1)
      if (const unsigned j = lowest_bit(mask); !(lowest[j] > limit))
        limit = visit(item(j));
    return limit;
  }

  /// Takes the top entry that is not farther than `limit`. Returns false where there is none.
  bool pop(double limit, Entry& entry) {
    while (!entries_.empty()) {
      entry = entries_.back();
      entries_.pop_back();
      if (!(entry.bound > limit))
        return true;
    }
    return false;
  }

  void reserve(std::size_t size) { entries_.reserve(size); }
  std::size_t memory() const { return entries_.capacity() * sizeof(Entry); }

private:
  std::vector<Entry> entries_;
};

} // namespace haptic_sculpt::internal
