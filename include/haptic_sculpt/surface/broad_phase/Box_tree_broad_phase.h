// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/broad_phase/Broad_phase_base.h>
#include <haptic_sculpt/surface/broad_phase/Growing_box_tree.h>
#include <haptic_sculpt/surface/broad_phase/Implicit_box_tree.h>
#include <haptic_sculpt/surface/broad_phase/spatial_order.h>

namespace haptic_sculpt {

/// The default broad phase: an implicit 8-wide tree of boxes over the faces in a spatial order.
///
/// Boxes are floats, in a unit of the scene's own (a power of two), rounded outward, so that every box contains what it
/// stands for; answers are supersets. Each face has a slot. Moves refit the boxes above the faces that moved, up to the
/// first that does not change. A new face takes a slot that was freed beside a face it shares an edge with; if there is
/// none it goes to an overflow tree that grows. Nothing is ever built anew. A model of BroadPhase
/// (doc/proofs/broad_phase.md).
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
    slot_of_face_.assign(mesh.num_faces(), no_slot);
    const std::vector<internal::Face_middle> order = internal::faces_in_spatial_order(mesh, mesh.faces(), scale());
    for (std::uint32_t slot = 0; slot < order.size(); ++slot)
      slot_of_face_[order[slot].face] = slot;
    tree_.build(order.size(), [&order](std::size_t slot) { return order[slot].face; },
                [this](std::uint32_t f) { return scale().around(face_box(this->mesh(), Face_index(f))); });
  }

  /// Appends at least every face whose closed box meets the closed box.
  void query(const Box_3& box, std::vector<Face_index>& faces) {
    const internal::Float_box around = scale().query(box);
    append([&around](const Node& node) { return node.meeting(around); }, faces, unlimited);
  }

  /// Appends the faces whose boxes pass the filter of the star; gives up where there are more than `most`. Returns
  /// whether the answer is whole.
  bool query_star(const Swept_star_3& star, std::vector<Face_index>& faces, std::size_t most = unlimited) {
    const internal::Star_filter filter(star, scale());
    return append([&filter](const Node& node) { return filter.meeting(node); }, faces, most);
  }

  /// Visits faces about in the order of a lower bound of what is sought, until nothing is left within the limit.
  /// \param bound `bound(node, lowest)` writes a lower bound for each of a node's eight boxes, and returns the bits of
  /// those that count, none of them empty \param visit `visit(face)` returns the limit from then on: faces whose boxes
  /// have a larger bound are left out. Cost: log n and what is visited.
  template <class Bound, class Visit>
  void visit_nearest_first(const Box_3& /*region*/, const Bound& bound, double limit, const Visit& visit) {
    const auto visit_item = [&visit](std::uint32_t f) { return visit(Face_index(f)); };
    overflow_.visit_nearest_first(bound, tree_.visit_nearest_first(bound, limit, visit_item), visit_item);
  }

  /// Begins to fetch from memory what a query about here will read. Changes no answer. Cost: log n.
  void fetch_ahead(const Box_3& box) { tree_.fetch_ahead(scale().query(box)); }
  /// Goes on with that for a level, whose nodes have come by now.
  void fetch_on() { tree_.fetch_on(); }

  /// Refits the boxes above. \pre each of the faces is known: it was there at the construction or has been inserted.
  template <class Faces>
  void faces_moved(const Faces& faces) {
    refit_around(faces, [this](Face_index f) { return face_box(mesh(), f); });
  }
  /// The same by several threads, where most of all faces have moved: then the boxes of all are made anew.
  template <class Faces, class Corners>
  void many_faces_moved(const Faces& faces, const Corners& corners_of, const Part_runner& run) {
    const auto box_of = [&](Face_index f) { return face_box(mesh(), corners_of(f)); };
    if (2 * faces.size() < slot_of_face_.size())
      return refit_around(faces, box_of);
    for (const Face_index f : faces)
      if (const std::uint32_t slot = slot_of_face_[f]; is_in_overflow(slot))
        overflow_.set(slot - first_overflow, scale().around(face_box(mesh(), f)));
    tree_.set_all([&](std::uint32_t f) { return scale().around(box_of(Face_index(f))); }, run);
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
    tree_.begin_changes();
    const std::size_t size = mesh().num_faces();
    if (size > slot_of_face_.capacity())
      slot_of_face_.reserve(size + size / 16); // not doubled: memory is promised
    slot_of_face_.resize(std::max(size, slot_of_face_.size()), no_slot);
    const struct Refit { // what has been set by then, where memory runs out in the overflow
      decltype(tree_)& tree;
      ~Refit() { tree.refit(); }
    } refit{tree_};
    for (const Face_index f : faces) {
      const internal::Float_box box = scale().around(face_box(mesh(), f));
      std::uint32_t& slot = slot_of_face_[f];
      if (slot == no_slot)
        slot = free_slot_beside(f);
      if (slot == no_slot) {
        insert_into_overflow(f, box);
        continue;
      }
      if (!is_in_overflow(slot))
        tree_.item(slot) = static_cast<std::uint32_t>(f);
      set(slot, box);
    }
  }

  /// Frees their slots; reads no mesh, and passes over faces that are not known.
  template <class Faces>
  void faces_removed(const Faces& faces) {
    tree_.begin_changes();
    for (const Face_index f : faces) {
      if (static_cast<std::size_t>(f) >= slot_of_face_.size() || slot_of_face_[f] == no_slot)
        continue;
      const std::uint32_t slot = slot_of_face_[f];
      if (is_in_overflow(slot)) {
        overflow_.remove(slot - first_overflow);
      } else {
        tree_.item(slot) = no_slot;
        tree_.set(slot, internal::Float_box());
      }
      slot_of_face_[f] = no_slot;
    }
    tree_.refit();
  }

  /// Makes room for this many faces in all, and this many insertions: none allocates. Moves and removals never do.
  void reserve(std::size_t faces, std::size_t insertions) {
    slot_of_face_.reserve(faces);
    if (insertions != 0)
      overflow_.reserve(insertions);
    tree_.reserve();
  }

  /// Bytes held, capacity included.
  std::size_t memory() const {
    return tree_.memory() + slot_of_face_.capacity() * sizeof(std::uint32_t) + overflow_.memory() + sizeof *this;
  }

private:
  using Node = internal::Box_node;

  static constexpr std::uint32_t no_slot = internal::Implicit_box_tree::none;
  static constexpr std::uint32_t first_overflow = std::uint32_t{1}
                                                  << 31; ///< slots from here on are places of the overflow

  using Base::mesh;
  using Base::scale;

  std::vector<std::uint32_t> slot_of_face_;
  internal::Implicit_box_tree tree_;
  internal::Growing_box_tree overflow_;

  static bool is_in_overflow(std::uint32_t slot) { return slot >= first_overflow && slot != no_slot; }

  /// \param box_of `box_of(face)`
  template <class Faces, class Box_of>
  void refit_around(const Faces& faces, const Box_of& box_of) {
    tree_.begin_changes();
    // From here on refitting all costs less than noting what has changed.
    const bool are_many = faces.size() >= tree_.number_of_nodes();
    for (const Face_index f : faces) {
      const internal::Float_box box = scale().around(box_of(f));
      if (const std::uint32_t slot = slot_of_face_[f]; are_many && !is_in_overflow(slot))
        tree_.set_without_noting(slot, box);
      else
        set(slot, box);
    }
    are_many ? tree_.refit_all() : tree_.refit();
  }

  void set(std::uint32_t slot, const internal::Float_box& box) {
    is_in_overflow(slot) ? overflow_.set(slot - first_overflow, box) : tree_.set(slot, box);
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
      if (const std::uint32_t slot = tree_.free_slot_beside(slot_of_face_[g]); slot != no_slot)
        return slot;
    }
    return no_slot;
  }

  /// Appends the faces that pass, `passing(node)` being a mask of eight, and gives up where there are more than `most`.
  /// Returns whether it did not.
  template <class Passing>
  bool append(const Passing& passing, std::vector<Face_index>& faces, std::size_t most) {
    const std::size_t first = faces.size();
    const auto put = [&faces](std::uint32_t f) { faces.push_back(Face_index(f)); };
    const auto are_too_many = [&] { return faces.size() - first > most; };
    return tree_.visit(passing, put, are_too_many) && overflow_.visit(passing, put, are_too_many);
  }
};

} // namespace haptic_sculpt
