// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_BOX_TREE_BROAD_PHASE_H
#define HAPTIC_SCULPT_SURFACE_BOX_TREE_BROAD_PHASE_H

#include <haptic_sculpt/surface/Cone_of_boxes.h>
#include <haptic_sculpt/surface/face_box.h>
#include <haptic_sculpt/surface/outward_float.h>
#include <haptic_sculpt/surface/spatial_order.h>

namespace haptic_sculpt {

/// The default broad phase: an implicit 8-wide tree of boxes over the faces in a spatial order.
///
/// Boxes are floats rounded outward, so that every box contains what it stands for; answers are supersets. Node k of a level
/// has the children 8k ... 8k + 7 of the level below, and the children of the lowest level are the slots, one a face: no pointers.
/// Moves refit the boxes from a slot up to the first one that does not change. New faces take freed slots, then slots at the end; the
/// tree is laid out anew when more have been added at the end than half of what it was built for.
/// A model of BroadPhase (doc/broad_phase.md).
///
/// Cost: build n log n; a query log n plus its answer; an update log n. 35.4 bytes a face. A query does not allocate once its
/// output and the stack have grown.
template <class Mesh>
class Box_tree_broad_phase {
public:
  using Face_index = typename Mesh::Face_index;

  explicit Box_tree_broad_phase(const Mesh& mesh) : mesh_(&mesh) { build(); }

  void query(const Box_3& box, std::vector<Face_index>& faces) {
    descend(Query_box(box), [](const Node&, int) { return true; }, faces);
  }

  void query(const Swept_star_3& star, std::vector<Face_index>& faces) {
    const internal::Cone_of_boxes cone(star);
    descend(Query_box(star.box()),
            [&cone](const Node& node, int j) {
              double lower[3], upper[3];
              for (int i = 0; i < 3; ++i)
                lower[i] = node.bounds[i][j], upper[i] = node.bounds[i + 3][j];
              return cone.may_meet(lower, upper);
            },
            faces);
  }

  template <class Faces>
  void faces_moved(const Faces& faces) {
    for (const Face_index f : faces)
      set(slot_of_face_[f], internal::Float_box(face_box(*mesh_, f)));
  }

  template <class Faces>
  void faces_inserted(const Faces& faces) {
    slot_of_face_.resize(mesh_->num_faces(), no_slot);
    for (const Face_index f : faces) {
      if (slot_of_face_[f] == no_slot)
        take_slot(f);
      set(slot_of_face_[f], internal::Float_box(face_box(*mesh_, f)));
    }
    if (face_of_slot_.size() > built_for_ + built_for_ / 2 + least_growth)
      build();
  }

  template <class Faces>
  void faces_removed(const Faces& faces) {
    for (const Face_index f : faces) {
      const std::uint32_t slot = slot_of_face_[f];
      if (slot == no_slot)
        continue;
      set(slot, internal::Float_box::none());
      slot_of_face_[f] = no_slot;
      free_slots_.push_back(slot);
    }
  }

  /// Bytes held, capacity included.
  std::size_t memory() const {
    std::size_t bytes = slot_of_face_.capacity() * sizeof(std::uint32_t) + face_of_slot_.capacity() * sizeof(std::uint32_t) +
                        free_slots_.capacity() * sizeof(std::uint32_t);
    for (const std::vector<Node>& level : levels_)
      bytes += level.capacity() * sizeof(Node);
    return bytes;
  }

private:
  static constexpr std::uint32_t no_slot = ~std::uint32_t{0};
  static constexpr std::size_t least_growth = 1024; ///< faces; a small mesh is not laid out anew all the time

  /// Eight boxes, bound by bound, so that one comparison of eight becomes one or two instructions.
  struct alignas(32) Node {
    float bounds[6][8]; ///< lower x, y, z; upper x, y, z

    Node() {
      for (int i = 0; i < 8; ++i)
        set(i, internal::Float_box::none());
    }
    void set(int j, const internal::Float_box& box) {
      for (int i = 0; i < 3; ++i)
        bounds[i][j] = box.lower[i], bounds[i + 3][j] = box.upper[i];
    }
    internal::Float_box all() const {
      internal::Float_box box;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 8; ++j) {
          box.lower[i] = bounds[i][j] < box.lower[i] ? bounds[i][j] : box.lower[i];
          box.upper[i] = bounds[i + 3][j] > box.upper[i] ? bounds[i + 3][j] : box.upper[i];
        }
      return box;
    }
    bool is(int j, const internal::Float_box& box) const {
      bool same = true;
      for (int i = 0; i < 3; ++i)
        same &= (bounds[i][j] == box.lower[i]) & (bounds[i + 3][j] == box.upper[i]);
      return same;
    }
  };

  struct Query_box {
    internal::Float_box box;
    explicit Query_box(const Box_3& b) : box(b) {}

    /// Bit j: whether the node's box j meets the query's.
    unsigned meets(const Node& node) const {
      int hit[8];
      for (int j = 0; j < 8; ++j)
        hit[j] = (node.bounds[0][j] <= box.upper[0]) & (node.bounds[1][j] <= box.upper[1]) &
                 (node.bounds[2][j] <= box.upper[2]) & (node.bounds[3][j] >= box.lower[0]) &
                 (node.bounds[4][j] >= box.lower[1]) & (node.bounds[5][j] >= box.lower[2]);
      unsigned mask = 0;
      for (int j = 0; j < 8; ++j)
        mask |= static_cast<unsigned>(hit[j]) << j;
      return mask;
    }
  };

  const Mesh* mesh_;
  std::vector<std::vector<Node>> levels_; ///< from the lowest; the last has one node
  std::vector<std::uint32_t> face_of_slot_, slot_of_face_, free_slots_;
  std::size_t built_for_ = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stack_; ///< level, node

  void build() {
    slot_of_face_.assign(mesh_->num_faces(), no_slot);
    face_of_slot_ = internal::faces_in_spatial_order(*mesh_);
    face_of_slot_.shrink_to_fit();
    free_slots_.clear();
    built_for_ = face_of_slot_.size();
    levels_.assign(1, std::vector<Node>((built_for_ + 7) / 8));
    for (std::size_t slot = 0; slot < built_for_; ++slot) {
      const Face_index f(face_of_slot_[slot]);
      slot_of_face_[f] = static_cast<std::uint32_t>(slot);
      levels_[0][slot / 8].set(static_cast<int>(slot % 8), internal::Float_box(face_box(*mesh_, f)));
    }
    while (levels_.back().size() > 1) {
      const std::vector<Node>& below = levels_.back();
      std::vector<Node> level((below.size() + 7) / 8);
      for (std::size_t k = 0; k < below.size(); ++k)
        level[k / 8].set(static_cast<int>(k % 8), below[k].all());
      levels_.push_back(std::move(level));
    }
  }

  /// Stores a slot's box and what changes above it.
  void set(std::size_t index, internal::Float_box box) {
    for (std::vector<Node>& level : levels_) {
      Node& node = level[index / 8];
      const int j = static_cast<int>(index % 8);
      if (node.is(j, box))
        return;
      node.set(j, box);
      box = node.all();
      index /= 8;
    }
  }

  void take_slot(Face_index f) {
    std::uint32_t slot;
    if (!free_slots_.empty()) {
      slot = free_slots_.back();
      free_slots_.pop_back();
    } else {
      slot = static_cast<std::uint32_t>(face_of_slot_.size());
      face_of_slot_.push_back(0);
      make_nodes_for(slot);
    }
    face_of_slot_[slot] = static_cast<std::uint32_t>(f);
    slot_of_face_[f] = slot;
  }

  void make_nodes_for(std::size_t index) {
    for (std::size_t l = 0;; ++l) {
      index /= 8;
      if (l == levels_.size()) { // a new root over the old one
        levels_.emplace_back(1);
        levels_[l][0].set(0, levels_[l - 1][0].all());
      }
      if (index < levels_[l].size())
        break;
      levels_[l].resize(index + 1);
    }
    while (levels_.back().size() > 1) {
      levels_.emplace_back(1);
      Node& root = levels_.back()[0];
      const std::vector<Node>& below = levels_[levels_.size() - 2];
      for (std::size_t k = 0; k < below.size(); ++k)
        root.set(static_cast<int>(k), below[k].all());
    }
  }

  /// Visits what meets the box and passes `also(node, child)`; a child that passes at the lowest level is a face.
  template <class Also>
  void descend(const Query_box& query, const Also& also, std::vector<Face_index>& faces) {
    if (levels_[0].empty())
      return;
    stack_.clear();
    stack_.emplace_back(static_cast<std::uint32_t>(levels_.size() - 1), 0);
    while (!stack_.empty()) {
      const auto [level, index] = stack_.back();
      stack_.pop_back();
      const Node& node = levels_[level][index];
      for (unsigned mask = query.meets(node); mask != 0; mask &= mask - 1) {
        const int j = __builtin_ctz(mask);
        if (!also(node, j))
          continue;
        const std::uint32_t child = 8 * index + static_cast<std::uint32_t>(j);
        if (level == 0)
          faces.push_back(Face_index(face_of_slot_[child]));
        else
          stack_.emplace_back(level - 1, child);
      }
    }
  }
};

} // namespace haptic_sculpt

#endif
