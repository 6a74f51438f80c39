// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/broad_phase/nearest_first.h>
#include <haptic_sculpt/surface/broad_phase/processor.h>
#include <haptic_sculpt/surface/containers/make_room.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace haptic_sculpt::internal {

/// The overflow of a laid-out tree: an 8-wide R-tree that takes boxes one by one, in log n each, and never moves its
/// nodes.
///
/// Every box is an item, a number, at a place: node * 8 + child. A full node met on the way down is halved, so that
/// there is always room for one more child above; that moves items, and `put(item, place)` is called.
class Growing_box_tree {
public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  /// Puts an item near others. `put(item, place)` is called for it and for every item that changes its place.
  template <class Put>
  void insert(std::uint32_t item, const Float_box& box, const Put& put) {
    reserve_nodes(height() + 3); // one a level, and a root: what throws has changed nothing
    if (root_ == none)
      root_ = new_node(0);
    if (node(root_).count == Box_node::width) {
      const std::uint32_t above = new_node(node(root_).height + 1);
      adopt(above, root_, node(root_).boxes.all(), put);
      halve(root_, put);
      root_ = above;
    }
    std::uint32_t at = root_;
    while (node(at).height != 0) {
      const std::uint32_t next = nearest_child(at, box);
      if (node(next).count == Box_node::width) {
        const std::uint32_t sibling = halve(next, put); // `at` may be full now, so it has to be one of these two
        at = growth(node(next).boxes.all(), box) <= growth(node(sibling).boxes.all(), box) ? next : sibling;
      } else {
        at = next;
      }
    }
    adopt(at, item, box, put);
    refit(at);
  }

  void set(std::uint32_t place, const Float_box& box) {
    Node& leaf = node(place / Box_node::width);
    if (leaf.boxes.is(place % Box_node::width, box))
      return;
    leaf.boxes.set(place % Box_node::width, box);
    refit(place / Box_node::width);
  }

  void remove(std::uint32_t place) {
    for (;;) {
      const std::uint32_t at = place / Box_node::width;
      Node& holder = node(at);
      holder.child[place % Box_node::width] = none;
      holder.boxes.set(place % Box_node::width, Float_box());
      if (--holder.count != 0)
        return refit(at);
      free_nodes_.push_back(at);
      if (at == root_) {
        root_ = none;
        return;
      }
      place = holder.parent;
    }
  }

  /// Visits the items whose boxes pass, `passing(Box_node)` being a mask of eight, until `found(item)` has been called
  /// for all those of a node and `is_enough()`. Returns whether all were visited.
  template <class Passing, class Visit, class Is_enough>
  bool visit(const Passing& passing, const Visit& found, const Is_enough& is_enough) {
    if (root_ == none)
      return true;
    stack_.assign(1, root_);
    while (!stack_.empty()) {
      const Node& n = node(stack_.back());
      stack_.pop_back();
      for (unsigned mask = passing(n.boxes); mask != 0; mask &= mask - 1) {
        const std::uint32_t child = n.child[lowest_bit(mask)];
        if (n.height == 0) {
          found(child);
        } else {
          prefetch(&node(child), sizeof(Node));
          stack_.push_back(child);
        }
      }
      if (n.height == 0 && is_enough())
        return false;
    }
    return true;
  }

  /// Visits items as Box_tree_broad_phase does. Returns the last limit.
  template <class Bound, class Visit>
  double visit_nearest_first(const Bound& bound, double limit, const Visit& visit) {
    if (root_ == none)
      return limit;
    nearest_.clear();
    nearest_.push({-std::numeric_limits<double>::infinity(), root_, 0});
    for (Nearest_first_stack::Entry next; nearest_.pop(limit, next);) {
      const Node& n = node(next.number);
      const auto child = [&n](unsigned j) { return n.child[j]; };
      if (n.height == 0)
        limit = Nearest_first_stack::visit_items(n.boxes, bound, limit, child, visit);
      else
        nearest_.push_children(n.boxes, 0, bound, limit, child);
    }
    return limit;
  }

  /// Makes room for this many insertions, whatever is removed meanwhile. Removals never need any.
  ///
  /// Nodes come by halving alone, and by a new root. A full node is halved at once, another only after at least four
  /// more children have come: of n insertions n / 4 halve leaves, n / 16 the nodes above, ... together n / 3, besides
  /// those that were full before, and what these bring about above, a third more. No insertion halves more than one
  /// node a level.
  void reserve(std::size_t insertions) {
    const std::size_t in_use = used_ - free_nodes_.size();
    const std::size_t full = std::min<std::size_t>(in_use + in_use / 3, insertions * (height() + 1));
    reserve_nodes(full + insertions / 3 + most_height);
    stack_.reserve(Box_node::width * most_height);
    nearest_.reserve(Box_node::width * most_height);
  }

  std::size_t memory() const {
    return blocks_.size() * block_size * sizeof(Node) + blocks_.capacity() * sizeof(blocks_[0]) +
           (free_nodes_.capacity() + stack_.capacity()) * sizeof(std::uint32_t) + nearest_.memory();
  }

private:
  struct Node {
    Box_node boxes;
    std::uint32_t child[Box_node::width]; ///< nodes, or items where the height is 0
    std::uint32_t parent;                 ///< the place of this node, unless it is the root
    std::uint32_t count, height;
  };
  static constexpr std::size_t most_height = 16; ///< of 2^32 items in nodes of four and more
  static constexpr std::size_t block_size = 256; ///< nodes; blocks never move, so that growing copies nothing

  std::vector<std::unique_ptr<Node[]>> blocks_;
  std::uint32_t used_ = 0, root_ = none;
  std::vector<std::uint32_t> free_nodes_, stack_;
  Nearest_first_stack nearest_;

  std::size_t height() { return root_ == none ? 0 : node(root_).height; }

  /// Makes room for this many new nodes, and to keep the numbers of all that may be freed.
  void reserve_nodes(std::size_t nodes) {
    while (blocks_.size() * block_size - used_ + free_nodes_.size() < nodes) {
      make_room(free_nodes_, (blocks_.size() + 1) * block_size);
      blocks_.push_back(std::make_unique<Node[]>(block_size));
    }
  }

  Node& node(std::uint32_t k) { return blocks_[k / block_size][k % block_size]; }

  std::uint32_t new_node(std::uint32_t height) {
    std::uint32_t k = used_;
    if (!free_nodes_.empty()) {
      k = free_nodes_.back();
      free_nodes_.pop_back();
    } else {
      ++used_; // there is room
    }
    Node& n = node(k);
    n.boxes = Box_node();
    std::fill(n.child, n.child + Box_node::width, none);
    n.parent = none;
    n.count = 0;
    n.height = height;
    return k;
  }

  /// \pre the node has room. Does not refit what is above.
  template <class Put>
  void adopt(std::uint32_t at, std::uint32_t child, const Float_box& box, const Put& put) {
    Node& n = node(at);
    const unsigned j = static_cast<unsigned>(std::find(n.child, n.child + Box_node::width, none) - n.child);
    n.child[j] = child;
    n.boxes.set(j, box);
    ++n.count;
    const std::uint32_t place = at * Box_node::width + j;
    if (n.height == 0)
      put(child, place);
    else
      node(child).parent = place;
  }

  /// Moves half of a full node's children, those beyond the middle of its longest extent, to a new sibling.
  /// \pre the parent has room  \return the sibling
  template <class Put>
  std::uint32_t halve(std::uint32_t full, const Put& put) {
    const std::uint32_t sibling = new_node(node(full).height);
    Node& n = node(full);
    const Box_node boxes = n.boxes;
    const Float_box around = boxes.all();
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      axis = around.upper[i] - around.lower[i] > around.upper[axis] - around.lower[axis] ? i : axis;
    std::array<std::pair<float, std::uint32_t>, Box_node::width> order;
    for (unsigned j = 0; j < Box_node::width; ++j) {
      const float middle = boxes.bounds[axis][j] / 2 + boxes.bounds[axis + 3][j] / 2;
      order[j] = {middle == middle ? middle : 0, j}; // not a number for a box from -infinity to +infinity
    }
    std::sort(order.begin(), order.end());
    for (unsigned k = Box_node::width / 2; k < Box_node::width; ++k) {
      const unsigned j = order[k].second;
      adopt(sibling, n.child[j], boxes.box(j), put);
      n.child[j] = none;
      n.boxes.set(j, Float_box());
      --n.count;
    }
    const std::uint32_t above = n.parent / Box_node::width;
    node(above).boxes.set(n.parent % Box_node::width, n.boxes.all());
    adopt(above, sibling, node(sibling).boxes.all(), put);
    return sibling;
  }

  /// By how much the sum of a box's extents grows when it takes in another.
  static float growth(const Float_box& box, const Float_box& other) {
    float sum = 0;
    for (int i = 0; i < 3; ++i)
      sum += std::max(0.f, box.lower[i] - other.lower[i]) + std::max(0.f, other.upper[i] - box.upper[i]);
    return sum;
  }

  static float sum_of_extents(const Float_box& box) {
    return (box.upper[0] - box.lower[0]) + (box.upper[1] - box.lower[1]) + (box.upper[2] - box.lower[2]);
  }

  /// The child whose box grows least, of those the smallest; any would be correct.
  std::uint32_t nearest_child(std::uint32_t at, const Float_box& box) {
    const Node& n = node(at);
    unsigned best = Box_node::width;
    std::pair<float, float> least;
    for (unsigned j = 0; j < Box_node::width; ++j) {
      if (n.child[j] == none)
        continue;
      const Float_box there = n.boxes.box(j);
      const std::pair<float, float> cost(growth(there, box), sum_of_extents(there));
      if (best == Box_node::width || cost < least)
        best = j, least = cost;
    }
    return n.child[best];
  }

  void refit(std::uint32_t at) {
    while (at != root_) {
      const Float_box box = node(at).boxes.all();
      const std::uint32_t place = node(at).parent;
      at = place / Box_node::width;
      if (node(at).boxes.is(place % Box_node::width, box))
        return;
      node(at).boxes.set(place % Box_node::width, box);
    }
  }
};

} // namespace haptic_sculpt::internal
