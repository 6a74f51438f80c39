// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Edit_result.h>
#include <haptic_sculpt/sculpting/edits/Change_maker.h>
#include <haptic_sculpt/sculpting/edits/Collapse_proof.h>
#include <haptic_sculpt/sculpting/edits/Creation_proof.h>
#include <haptic_sculpt/sculpting/edits/Edit_history.h>
#include <haptic_sculpt/sculpting/edits/Flip_proof.h>
#include <haptic_sculpt/sculpting/edits/Pivot_order.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <algorithm>
#include <memory>

namespace haptic_sculpt::internal {

/// Creates and removes vertices of a mesh and flips edges by Euler operations: each is proven and then done, or refused
/// and nothing has changed. Also takes changes back and makes them again, in the steps of the history. Change_maker
/// makes what is decided here. See doc/use/edits.md.
template <class Mesh, class Broad_phase, class Visitor = Default_edit_visitor>
class Editor {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;
  using Halfedge_index = typename Mesh::Halfedge_index;
  using Point = typename Mesh::Point;
  using Result = Edit_result<Mesh>;

  /// \param watch hears of what has changed \param writing while anything is written
  Editor(Mesh& mesh, Broad_phase& broad_phase, Face_corners<Mesh>& corners, Filter_counters& counters,
         Mesh_watch<Mesh>& watch, Write_state& writing, Visitor visitor = Visitor())
      : mesh_(&mesh)
      , watch_(&watch)
      , writing_(&writing)
      , changes_(mesh, broad_phase, corners, watch, writing, std::move(visitor))
      , creation_(mesh, broad_phase, corners, counters)
      , collapse_(mesh, broad_phase, corners, counters)
      , flip_(mesh, broad_phase, corners, counters) {}

  const Vertex_ids<Mesh>& ids() const { return changes_.ids(); }
  Visitor& visitor() { return changes_.visitor(); }
  Kept_properties<Mesh>& kept() { return changes_.kept(); }
  Edit_history& history() { return history_; }
  const Edit_history& history() const { return history_; }

  /// Many drags may follow: what they need for undo is allocated now.
  void prepare_for_moves() { history_.make_room(); }

  /// This many edits and moves follow: what they need is allocated now, for stars of `valence` faces and this many
  /// candidates about them.
  void reserve(std::size_t edits, std::size_t moves, std::size_t valence, std::size_t candidates) {
    changes_.reserve(edits, valence); // first: it refuses what no mesh can have before memory is asked for
    history_.reserve(edits, moves, ids().size() + edits, valence);
    creation_.reserve(candidates);
    collapse_.reserve(valence, candidates);
    flip_.reserve(candidates);
    order_.reserve(valence);
    change_.around.reserve(valence);
  }

  /// Room to note a drag, to be made before it is. \throw std::bad_alloc
  void make_room_for_move() { history_.make_room_for_move(ids().size()); }
  /// A drag that has been made. Allocates nothing.
  void note_move(Vertex_index v, const Coordinates& before, const Coordinates& after) {
    history_.push_move(ids().id(v), before, after);
  }
  /// The visitor hears of it.
  void tell_moved(Vertex_index v) { changes_.tell_moved(v); }

  Result insert_on_face(Face_index f, const Coordinates& p, double delta) {
    const Halfedge_index h = mesh_->halfedge(f);
    if (auto refusal = creation_.refuse({h}, p, delta))
      return {std::nullopt, std::move(refusal)};
    describe(Edit_kind::insert_on_face, {mesh_->source(h), mesh_->target(h), mesh_->target(mesh_->next(h))}, p);
    change_.around.push_back(ids().size());
    return make();
  }

  Result insert_on_edge(Halfedge_index h, const Coordinates& p, double delta) {
    if (auto refusal = creation_.refuse({h, mesh_->opposite(h)}, p, delta))
      return {std::nullopt, std::move(refusal)};
    describe(Edit_kind::insert_on_edge, {mesh_->source(h), mesh_->target(h)}, p);
    change_.around.push_back(ids().size());
    return make();
  }

  /// Draws the source of h into its target.
  Result collapse(Halfedge_index h, double delta) {
    auto refusal = collapse_.begin(mesh_->source(h));
    const std::vector<Vertex_index>& link = collapse_.star().link;
    const auto pivot = static_cast<std::size_t>(std::find(link.begin(), link.end(), mesh_->target(h)) - link.begin());
    if (!refusal)
      refusal = collapse_.refuse(pivot, delta);
    return refusal ? Result{std::nullopt, std::move(refusal)} : collapse_into(pivot);
  }

  /// Draws v into each neighbour in turn, the one first whose fan has the largest least angle, until one is free. Of
  /// equal ones their numbers tell, not where the mesh's own circulators begin: undo does not restore that.
  Result remove(Vertex_index v, double delta) {
    if (auto refusal = collapse_.begin(v))
      return {std::nullopt, std::move(refusal)};
    const std::vector<Vertex_index>& link = collapse_.star().link;
    const auto first = std::min_element(link.begin(), link.end(),
                                        [this](Vertex_index a, Vertex_index b) { return ids().id(a) < ids().id(b); });
    order_.begin(collapse_.star(), static_cast<std::size_t>(first - link.begin()));
    std::optional<Refusal<Mesh>> gravest;
    while (const auto pivot = order_.next()) {
      auto refusal = collapse_.refuse(*pivot, delta);
      if (!refusal)
        return collapse_into(*pivot);
      // Of those for the several pivots, the last in the order of the checks says most.
      if (!gravest || refusal->reason > gravest->reason)
        gravest = std::move(refusal);
    }
    return {std::nullopt, std::move(gravest)};
  }

  Result flip(Halfedge_index h, double delta) {
    if (auto refusal = flip_.refuse(h, delta))
      return {std::nullopt, std::move(refusal)};
    const auto& [a, b, c, d] = flip_.corners();
    describe(Edit_kind::flip, {a, b}, {});
    change_.around = {ids().id(c), ids().id(d)};
    return make();
  }

  /// Moves many vertices along one axis, a motion that has been proven free; one change. \param ways where each is to
  /// be
  void shift(int axis, const std::vector<std::pair<Vertex_index, double>>& ways,
             const Part_runner& run = Part_runner()) {
    auto made = std::make_unique<Change>(); // kept in a trial only: there may be millions
    Change& change = *made;
    change.edit = Edit::of(Edit_kind::shift);
    change.edit.axis = axis;
    change.edit.ways.reserve(ways.size());
    change.starts.reserve(ways.size());
    for (const auto& [v, end] : ways) {
      change.edit.ways.emplace_back(ids().id(v), end);
      change.starts.push_back(vertex_coordinates(*mesh_, v)[axis]);
    }
    history_.make_room_for(change);
    const auto noted = [&](Vertex_index changed) {
      watch(changed, change.edit);
      history_.push_shift(made);
    };
    changes_.make(change, place(history_.number_of_next(), true), noted, run);
  }
  /// Takes the last shift of a trial back. Allocates nothing, but a broad phase of the caller's own may.
  void take_back_tried_shift(const Part_runner& run) {
    const Change& change = history_.tried_shift();
    std::unique_ptr<Change> dropped; // once the visitor has heard
    const auto noted = [&](Vertex_index changed) {
      watch(changed, change.edit);
      dropped = history_.drop_tried_shift();
    };
    changes_.take_back(change, place(history_.number_of_next(), true), noted, run);
  }

  /// Whether the visitor hears of what changes; at first it does.
  void tell_visitor(bool does) { changes_.tell_visitor(does); }

  /// Takes the last step back. No proof is needed: the mesh was embedded before it, and moved back it is so again. What
  /// delta is now does not matter.
  Result undo() {
    return go_through_step(Refusal_reason::nothing_to_undo, [this] { return history_.to_undo(); }, true);
  }

  /// Makes the last step that was taken back again.
  Result redo() {
    return go_through_step(Refusal_reason::nothing_to_redo, [this] { return history_.to_redo(); }, false);
  }

  /// The face with these three corners, by number and in any order; the null index where there is none.
  /// \throw Mesh_changed
  Face_index face_of(std::size_t a, std::size_t b, std::size_t c) const {
    const Halfedge_index h = halfedge_of(a, b);
    const Vertex_index third = ids().vertex(c);
    if (!h.is_valid() || !third.is_valid())
      return Face_index();
    for (const Halfedge_index g : {h, mesh_->opposite(h)})
      if (mesh_->target(mesh_->next(g)) == third)
        return mesh_->face(g);
    return Face_index();
  }

  /// The halfedge from a to b, by number; the null index where there is none. \throw Mesh_changed
  Halfedge_index halfedge_of(std::size_t a, std::size_t b) const {
    watch_->check_counts(); // of a mesh that others have made smaller the numbers lead beyond its end
    const Vertex_index v = ids().vertex(a), w = ids().vertex(b);
    if (!v.is_valid() || !w.is_valid() || v == w)
      return Halfedge_index();
    return mesh_->halfedge(v, w);
  }

private:
  Mesh* mesh_;
  Mesh_watch<Mesh>* watch_;
  Write_state* writing_;
  Change_maker<Mesh, Broad_phase, Visitor> changes_;
  Edit_history history_;
  Creation_proof<Mesh, Broad_phase> creation_;
  Collapse_proof<Mesh, Broad_phase> collapse_;
  Flip_proof<Mesh, Broad_phase> flip_;
  Pivot_order<Mesh> order_;
  Change change_; ///< the one that is made, kept to allocate no more
  bool has_changed_ = false; ///< the mesh, by the last change that was to be taken back or made again
  bool is_reversing_ = false; ///< such changes are being reversed

  /// Takes a step back or makes it again, all of its changes or none: a part of a step need not be embedded. Where an
  /// exception comes before the last change is made, those before it are undone, and the stroke under way goes on.
  /// Else that has ended. \param next gives the next change
  template <class Next>
  Result go_through_step(Refusal_reason nothing, const Next& next, bool is_back) {
    if (next() == nullptr) {
      history_.end_stroke();
      return Result::refused(nothing);
    }
    for (std::size_t changes = 0;; ++changes) {
      try {
        const Vertex_index v = is_back ? take_back() : make_again();
        if (history_.is_between_steps()) {
          history_.end_stroke();
          return Result::done(v);
        }
      } catch (...) {
        if (writing_->is_under_way() || (has_changed_ && history_.is_between_steps()))
          history_.end_stroke();
        else
          reverse(changes + has_changed_, is_back);
        throw;
      }
    }
  }

  /// Reverses this many changes that were taken back or made again last. The visitor hears of it until it throws.
  void reverse(std::size_t changes, bool is_back) {
    bool is_tried_again = false; // the change at hand, as its record or a map has thrown before anything was written
    is_reversing_ = true;
    while (changes != 0) {
      try {
        is_back ? make_again() : take_back();
      } catch (...) {
        const bool is_of_visitor = changes_.has_visitor_thrown();
        if (writing_->is_under_way() || (!has_changed_ && !is_of_visitor && is_tried_again)) {
          history_.end_stroke();
          is_reversing_ = false;
          writing_->begin(); // for good
          throw;
        }
        if (is_of_visitor)
          changes_.tell_visitor(false);
        is_tried_again = is_tried_again || !is_of_visitor;
      }
      changes -= has_changed_;
      is_tried_again = is_tried_again && !has_changed_;
    }
    is_reversing_ = false;
    changes_.tell_visitor(true);
  }

  Vertex_index take_back() {
    has_changed_ = false;
    const auto at = place(history_.number_to_undo(), false);
    const Change& change = *history_.to_undo();
    return changes_.take_back(change, at, [&](Vertex_index changed) {
      watch(changed, change.edit);
      history_.undone();
      has_changed_ = true;
    });
  }
  Vertex_index make_again() {
    has_changed_ = false;
    const auto at = place(history_.number_to_redo(), false);
    const Change& change = *history_.to_redo();
    return changes_.make(change, at, [&](Vertex_index changed) {
      watch(changed, change.edit);
      history_.redone();
      has_changed_ = true;
    });
  }

  typename Kept_properties<Mesh>::Place place(std::size_t number, bool is_new) const {
    return {history_.first_number(), number, is_new, is_reversing_};
  }

  void describe(Edit_kind kind, std::initializer_list<Vertex_index> vertices, const Coordinates& p) {
    change_.edit = Edit::of(kind, {}, p);
    std::transform(vertices.begin(), vertices.end(), change_.edit.vertices.begin(),
                   [this](Vertex_index v) { return ids().id(v); });
    change_.before = p;
    change_.around.clear();
  }

  Result collapse_into(std::size_t pivot) {
    const Star<Mesh>& star = collapse_.star();
    describe(Edit_kind::collapse, {star.centre, star.link[pivot]}, collapse_.centre());
    for (std::size_t i = 0; i < star.valence(); ++i)
      change_.around.push_back(ids().id(star.link[(pivot + i) % star.valence()]));
    return make();
  }

  Result make() { return Result::done(make(change_)); }
  Vertex_index make(const Change& change) {
    history_.make_room_for(change);
    const auto noted = [&](Vertex_index changed) {
      watch(changed, change.edit);
      history_.push(change);
    };
    return changes_.make(change, place(history_.number_of_next(), true), noted);
  }

  /// Of a shift all that it moves.
  void watch(Vertex_index changed, const Edit& edit) {
    watch_->remember_counts();
    if (changed.is_valid())
      watch_->remember(changed);
    if (edit.kind == Edit_kind::shift)
      for (const auto& way : edit.ways)
        watch_->remember(ids().vertex(way.first));
  }
};

} // namespace haptic_sculpt::internal
