// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/broad_phase/Broad_phase_base.h>
#include <haptic_sculpt/surface/broad_phase/Growing_box_tree.h>
#include <haptic_sculpt/surface/broad_phase/spatial_order.h>

namespace haptic_sculpt {

/// The default broad phase: an implicit 8-wide tree of boxes over the faces in a spatial order.
///
/// Boxes are floats, in a unit of the scene's own (a power of two), rounded outward, so that every box contains what it
/// stands for; answers are supersets. Node k of a
/// level has the children 8k ... 8k + 7 of the level below, and the children of the lowest level are the slots, one a
/// face: no pointers. Moves refit the boxes above the faces that moved, up to the first that does not change. A new
/// face takes a slot that was freed beside a face it shares an edge with; if there is none it goes to an overflow tree
/// that grows. Nothing is ever built anew. A model of BroadPhase (doc/proofs/broad_phase.md).
///
/// Cost: build n log n; a query log n plus its answer; an update log n. 35.4 bytes a face, about 60 for one in the
/// overflow. A query allocates nothing once its output has grown; neither do moves.
template <class Mesh>
class Box_tree_broad_phase : public Broad_phase_base<Mesh, Box_tree_broad_phase<Mesh>> {
  using Base = Broad_phase_base<Mesh, Box_tree_broad_phase>;
  using Base::unlimited;

public:
  using Face_index = typename Mesh::Face_index; ///< what queries append

  /// Builds the tree: n log n. \param mesh has to outlive this
  explicit Box_tree_broad_phase(const Mesh& mesh) : Base(mesh) {
    touched_.reserve(most_touched + 1);
    build();
  }

  /// Appends at least every face whose closed box meets the closed box.
  void query(const Box_3& box, std::vector<Face_index>& faces) {
    const internal::Float_box around = scale().query(box);
    descend([&around](const Node& node) { return node.meeting(around); }, faces);
  }

  /// Appends the faces whose boxes pass the filter of the star; gives up where there are more than `most`. Returns
  /// whether the answer is whole.
  bool query_star(const Swept_star_3& star, std::vector<Face_index>& faces, std::size_t most = unlimited) {
    const internal::Star_filter filter(star, scale());
    return descend([&filter](const Node& node) { return filter.meeting(node); }, faces, most);
  }

  /// Visits faces about in the order of a lower bound of what is sought, until nothing is left within the limit.
  /// \param bound `bound(node, lowest)` writes a lower bound for each of a node's eight boxes, and returns the bits of
  /// those that count, none of them empty \param visit `visit(face)` returns the limit from then on: faces whose boxes
  /// have a larger bound are left out. Cost: log n and what is visited.
  template <class Bound, class Visit>
  void visit_nearest_first(const Box_3& /*region*/, const Bound& bound, double limit, const Visit& visit) {
    nearest_.clear();
    if (levels_ != 0)
      nearest_.push({-std::numeric_limits<double>::infinity(), 0, levels_ - 1});
    for (internal::Nearest_first_stack::Entry next; nearest_.pop(limit, next);) {
      const std::uint32_t first = next.number * width;
      const int level = next.level;
      const Node& node = nodes_[level_begin_[level] + next.number];
      if (level == 0) {
        limit = internal::Nearest_first_stack::visit_items(
            node, bound, limit, [&](unsigned j) { return Face_index(face_of_slot_[first + j]); }, visit);
        continue;
      }
      nearest_.push_children(node, level - 1, bound, limit, [&](unsigned j) {
        internal::prefetch(&nodes_[level_begin_[level - 1] + first + j], sizeof(Node));
        if (level == 1)
          internal::prefetch(&face_of_slot_[std::size_t{first + j} * width], width * sizeof(std::uint32_t));
        return first + j;
      });
    }
    overflow_.visit_nearest_first(bound, limit, [&visit](std::uint32_t f) { return visit(Face_index(f)); });
  }

  /// Begins to fetch from memory what a query about here will read. Changes no answer. Cost: log n.
  void fetch_ahead(const Box_3& box) {
    if (levels_ == 0 || level_begin_[0] < nodes_in_cache)
      return;
    ahead_ = scale().query(box);
    to_root();
    while (is_worth_fetching() && level_begin_[level_ - 1] < nodes_in_cache)
      fetch_on();
  }
  /// Goes on with that for a level, whose nodes have come by now.
  void fetch_on() {
    if (is_worth_fetching())
      go_down([this](const Node& node) { return node.meeting(ahead_); }, end_);
  }

  /// Refits the boxes above. \pre each of the faces is known: it was there at the construction or has been inserted.
  template <class Faces>
  void faces_moved(const Faces& faces) {
    refit_around(faces, [this](Face_index f) { return face_box(mesh(), f); });
  }
  /// The same by several threads, where most of all faces have moved: then the boxes of all are made anew.
  template <class Faces, class Corners>
  void many_faces_moved(const Faces& faces, const Corners& corners_of, const Part_runner& run) {
    if (2 * faces.size() < slot_of_face_.size())
      return refit_around(faces, [&](Face_index f) { return face_box(mesh(), corners_of(f)); });
    run.in_ranges(face_of_slot_.size(), slots_a_part, [&](std::size_t first, std::size_t end) {
      for (std::size_t slot = first; slot < end; ++slot)
        if (face_of_slot_[slot] != no_face)
          nodes_[level_begin_[0] + slot / width].set(
              slot % width, scale().around(face_box(mesh(), corners_of(Face_index(face_of_slot_[slot])))));
    });
    for (const Face_index f : faces)
      if (const std::uint32_t slot = slot_of_face_[f]; is_in_overflow(slot))
        overflow_.set(slot - first_overflow, scale().around(face_box(mesh(), f)));
    internal::refit_all(nodes_, level_begin_.data(), levels_, run);
  }

  /// As they lie in the tree. \pre all are known
  void put_in_order(std::vector<Face_index>& faces) const {
    std::vector<std::pair<std::uint32_t, Face_index>> by_slot;
    by_slot.reserve(faces.size());
    for (const Face_index f : faces)
      by_slot.emplace_back(slot_of_face_[f], f);
    std::sort(by_slot.begin(), by_slot.end());
    for (std::size_t i = 0; i < faces.size(); ++i)
      faces[i] = by_slot[i].second;
  }

  /// Reads their corners and neighbours from the mesh; one that is known already keeps its slot.
  template <class Faces>
  void faces_inserted(const Faces& faces) {
    touched_.clear();
    const std::size_t size = mesh().num_faces();
    if (size > slot_of_face_.capacity())
      slot_of_face_.reserve(size + size / 16); // not doubled: memory is promised
    slot_of_face_.resize(std::max(size, slot_of_face_.size()), no_slot);
    for (const Face_index f : faces) {
      const internal::Float_box box = scale().around(face_box(mesh(), f));
      std::uint32_t& slot = slot_of_face_[f];
      if (slot == no_slot)
        slot = free_slot_beside(f);
      if (slot != no_slot)
        take(slot, f, box);
      else
        insert_into_overflow(f, box);
    }
    refit();
  }

  /// Frees their slots; reads no mesh, and passes over faces that are not known.
  template <class Faces>
  void faces_removed(const Faces& faces) {
    touched_.clear();
    for (const Face_index f : faces) {
      if (static_cast<std::size_t>(f) >= slot_of_face_.size() || slot_of_face_[f] == no_slot)
        continue;
      const std::uint32_t slot = slot_of_face_[f];
      if (is_in_overflow(slot)) {
        overflow_.remove(slot - first_overflow);
      } else {
        face_of_slot_[slot] = no_face;
        place(slot, internal::Float_box());
      }
      slot_of_face_[f] = no_slot;
    }
    refit();
  }

  /// Makes room for this many faces in all, and this many insertions: none allocates. Moves and removals never do.
  void reserve(std::size_t faces, std::size_t insertions) {
    slot_of_face_.reserve(faces);
    if (insertions != 0)
      overflow_.reserve(insertions);
    nearest_.reserve(std::size_t{width} * (most_levels + 1));
    if (queue_.size() < largest_queue)
      queue_.resize(largest_queue);
  }

  /// Bytes held, capacity included.
  std::size_t memory() const {
    return nodes_.capacity() * sizeof(Node) + slot_of_face_.capacity() * sizeof(std::uint32_t) +
           face_of_slot_.capacity() * sizeof(std::uint32_t) +
           (touched_.capacity() + queue_.capacity()) * sizeof(std::uint32_t) + nearest_.memory() + overflow_.memory() +
           sizeof *this;
  }

private:
  using Node = internal::Box_node;

  static constexpr std::uint32_t width = Node::width;
  static constexpr std::uint32_t no_slot = ~std::uint32_t{0}, no_face = no_slot;
  static constexpr std::uint32_t first_overflow = std::uint32_t{1}
                                                  << 31; ///< slots from here on are places of the overflow
  static constexpr int most_levels = 11;                 ///< 8^11 > 2^31

  /// Levels that begin before this node, at 192 KiB, are taken to be in cache. With more nodes on a level than
  /// most_ahead nothing is fetched: what was guessed is much too large.
  static constexpr std::uint32_t nodes_in_cache = 1024, most_ahead = 64;

  static constexpr std::size_t most_at_once = 128; ///< nodes of a level, in a query
  /// Of a query at most, each portion's children on every level.
  static constexpr std::size_t largest_queue = std::size_t{most_levels} * width * most_at_once + width;
  static constexpr std::size_t slots_a_part = 1024 * width; ///< that threads work on; no two share a node
  static constexpr std::size_t most_touched = 256; ///< before they are refitted: there is room for this many

  using Base::mesh;
  using Base::scale;

  std::vector<Node> nodes_;                              ///< level by level from the root
  std::array<std::uint32_t, most_levels> level_begin_{}; ///< of the lowest level first; the last is the root's, 0
  int levels_ = 0;
  std::vector<std::uint32_t> face_of_slot_; ///< eight for each node of the lowest level
  std::vector<std::uint32_t> slot_of_face_;
  internal::Growing_box_tree overflow_;
  std::vector<std::uint32_t> touched_; ///< nodes of one level with a box that has changed
  std::vector<std::uint32_t> queue_;   ///< nodes that a query goes through, level by level
  std::size_t begin_ = 0, end_ = 0;    ///< those of the level at hand
  int level_ = 0;                      ///< of which the nodes at hand are
  internal::Float_box ahead_;          ///< what is fetched ahead
  internal::Nearest_first_stack nearest_;

  static bool is_in_overflow(std::uint32_t slot) { return slot >= first_overflow && slot != no_slot; }

  void build() {
    slot_of_face_.assign(mesh().num_faces(), no_slot);
    const std::vector<internal::Face_middle> order = internal::faces_in_spatial_order(mesh(), mesh().faces(), scale());
    if (order.empty())
      return;
    std::array<std::uint32_t, most_levels> sizes{};
    std::size_t size = order.size();
    do
      size = sizes[levels_++] = static_cast<std::uint32_t>((size + width - 1) / width);
    while (size > 1);
    std::uint32_t begin = 0;
    for (int level = levels_ - 1; level >= 0; --level)
      level_begin_[level] = begin, begin += sizes[level];
    nodes_.resize(begin);
    face_of_slot_.assign(std::size_t{sizes[0]} * width, no_face);
    for (std::uint32_t slot = 0; slot < order.size(); ++slot) {
      const Face_index f(order[slot].face);
      face_of_slot_[slot] = order[slot].face;
      slot_of_face_[f] = slot;
      nodes_[level_begin_[0] + slot / width].set(slot % width, scale().around(face_box(mesh(), f)));
    }
    internal::refit_all(nodes_, level_begin_.data(), levels_);
  }

  /// \param box_of `box_of(face)`
  template <class Faces, class Box_of>
  void refit_around(const Faces& faces, const Box_of& box_of) {
    touched_.clear();
    const bool are_many = faces.size() >= nodes_.size(); // then refitting all costs less than noting what has changed
    for (const Face_index f : faces) {
      const internal::Float_box box = scale().around(box_of(f));
      if (const std::uint32_t slot = slot_of_face_[f]; are_many && !is_in_overflow(slot))
        nodes_[level_begin_[0] + slot / width].set(slot % width, box);
      else
        place(slot, box);
    }
    are_many ? internal::refit_all(nodes_, level_begin_.data(), levels_) : refit();
  }

  /// Sets the box of a slot and notes what is to be refitted.
  void place(std::uint32_t slot, const internal::Float_box& box) {
    if (is_in_overflow(slot)) {
      overflow_.set(slot - first_overflow, box);
    } else {
      if (touched_.size() == most_touched) {
        refit();
        touched_.clear();
      }
      touched_.push_back(0);
      touched_.resize(set(0, slot, box, touched_.size() - 1));
    }
  }

  /// Sets the box of child `index` of a level. Where that changes anything notes its node behind the first `count`
  /// touched ones, unless it is among the last of them: the faces of a star share nodes. \return how many are noted
  std::size_t set(int level, std::uint32_t index, const internal::Float_box& box, std::size_t count) {
    Node& node = nodes_[level_begin_[level] + index / width];
    if (node.is(index % width, box))
      return count;
    node.set(index % width, box);
    const std::size_t looked_at = std::min<std::size_t>(count, 8); // a node noted twice costs time only
    const auto end = touched_.begin() + count;
    if (std::find(end - looked_at, end, index / width) == end)
      touched_[count++] = index / width;
    return count;
  }

  /// Brings the boxes above the touched nodes up to date.
  void refit() {
    for (int level = 1; level < levels_ && !touched_.empty(); ++level) {
      std::size_t count = 0; // nodes of this level are written over those of the level below that have been read
      for (std::size_t k = 0; k < touched_.size(); ++k)
        count = set(level, touched_[k], nodes_[level_begin_[level - 1] + touched_[k]].all(), count);
      touched_.resize(count);
    }
  }

  void take(std::uint32_t slot, Face_index f, const internal::Float_box& box) {
    if (!is_in_overflow(slot))
      face_of_slot_[slot] = static_cast<std::uint32_t>(f);
    place(slot, box);
  }

  void insert_into_overflow(Face_index f, const internal::Float_box& box) {
    overflow_.insert(static_cast<std::uint32_t>(f), box,
                     [this](std::uint32_t face, std::uint32_t place) { slot_of_face_[face] = first_overflow + place; });
  }

  /// A free slot in the node of a face that shares an edge with f, or no_slot.
  std::uint32_t free_slot_beside(Face_index f) const {
    auto h = mesh().halfedge(f);
    for (int i = 0; i < 3; ++i, h = mesh().next(h)) {
      const Face_index g = mesh().face(mesh().opposite(h));
      if (static_cast<std::size_t>(g) >= slot_of_face_.size() || slot_of_face_[g] >= first_overflow)
        continue;
      const auto begin = face_of_slot_.begin() + slot_of_face_[g] / width * width, end = begin + width;
      const auto found = std::find(begin, end, no_face);
      if (found != end)
        return static_cast<std::uint32_t>(found - face_of_slot_.begin());
    }
    return no_slot;
  }

  /// Visits the children that pass, `passing(node)` being a mask of eight; at the lowest level they are faces. Returns
  /// false where it was given up.
  template <class Passing>
  bool descend(const Passing& passing, std::vector<Face_index>& faces, std::size_t most = unlimited) {
    const std::size_t first = faces.size();
    const auto is_whole = [&] { return faces.size() - first <= most; };
    to_root();
    if (!visit_below(passing, faces, is_whole))
      return false;
    overflow_.visit(passing, [&faces](std::uint32_t f) { faces.push_back(Face_index(f)); });
    return is_whole();
  }

  /// What is below the nodes at hand, a portion of them after the other: the queue stays short, and where too much
  /// passes that is known before all nodes of a level have been read.
  template <class Passing, class Is_whole>
  bool visit_below(const Passing& passing, std::vector<Face_index>& faces, const Is_whole& is_whole) {
    while (level_ > 0 && begin_ != end_) {
      const std::size_t end = end_, last = std::min(end, begin_ + most_at_once);
      const int level = level_;
      go_down(passing, last);
      if (last == end)
        continue;
      if (!visit_below(passing, faces, is_whole))
        return false;
      begin_ = last, end_ = end, level_ = level;
    }
    for (; begin_ != end_; ++begin_) {
      for (unsigned mask = passing(nodes_[level_begin_[0] + queue_[begin_]]); mask != 0; mask &= mask - 1)
        faces.push_back(Face_index(face_of_slot_[std::size_t{queue_[begin_]} * width + internal::lowest_bit(mask)]));
      if (!is_whole())
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
    const Node* const nodes = &nodes_[level_begin_[level_]];
    const Node* const children = &nodes_[level_begin_[level_ - 1]];
    std::size_t count = end_;
    for (; begin_ != last; ++begin_) {
      if (queue_.size() < count + width)
        queue_.resize(2 * (count + width));
      const std::uint32_t first = queue_[begin_] * width;
      for (unsigned mask = passing(nodes[queue_[begin_]]); mask != 0; mask &= mask - 1) {
        const std::uint32_t child = first + internal::lowest_bit(mask);
        internal::prefetch(children + child, sizeof(Node));
        if (level_ == 1)
          internal::prefetch(&face_of_slot_[std::size_t{child} * width], width * sizeof(std::uint32_t));
        queue_[count++] = child;
      }
    }
    begin_ = end_, end_ = count;
    --level_;
  }
};

} // namespace haptic_sculpt
