// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Batch_bits.h"
#include "Batch_script.h"
#include "Random_places.h"
#include "batches.h"
#include "is_feasible_creation.h"
#include "sculpting/Mesh_snapshot.h"

#include <optional>

namespace haptic_sculpt::robustness {

/// One batch of drags, creations, removals, collapses, flips, undo and redo mixed, part of them in strokes, on a fresh
/// copy of the mesh; in the end all is undone, which has to give the input bit for bit, and redone, which has to give
/// the end.
template <class Broad_phase>
class Edit_batch {
public:
  /// \throw Invalid_parameter where the clearance does not serve
  Edit_batch(const Mesh& mesh, const Batch& batch)
      : batch_(batch)
      , mesh_(mesh)
      , sculptor_(mesh_, batch.parameters())
      , places_(mesh_, batch.seed)
      , vertices_at_first_(mesh.number_of_vertices()) {}

  Batch_made<Edit_tally> run(Keep keep) {
    std::optional<test::Mesh_snapshot> input;
    if (!batch_.has_only_bits)
      input = test::snapshot(sculptor_);
    bool has_outgrown_clearance = false;
    try {
      make_edits();
    } catch (const Invalid_parameter&) {
      if (!batch_.clearance)
        throw;
      has_outgrown_clearance = true;
    }
    end_stroke();
    check();
    for (script_.add("redo"); sculptor_.redo(); script_.add("redo"))
      ;
    bits_.add(mesh_);
    Batch_made<Edit_tally> made{{}, bits_.value(), {}, keep == Keep::all ? mesh_ : Mesh(), has_outgrown_clearance};
    if (!batch_.has_only_bits)
      undo_and_redo_all(*input);
    if (keep == Keep::all || tally_.is_any_promise_broken())
      made.script = script_.text(batch_.opening());
    made.tally = tally_;
    return made;
  }

private:
  static constexpr std::size_t judged_share = 16; ///< the decision is linear in the mesh

  using Sculptor_type = Sculptor<Mesh, Broad_phase>;
  using Edited = Edit_result<Mesh>;

  Batch batch_;
  Batch_script script_;
  Batch_bits bits_;
  Mesh mesh_;
  Sculptor_type sculptor_;
  Random_places places_;
  std::size_t vertices_at_first_;
  std::optional<Grab<Sculptor_type>> grab_; ///< kept in hand while other edits go on
  std::optional<Stroke<Sculptor_type>> stroke_;
  Edit_tally tally_;

  void make_edits() {
    std::size_t next_check = batch_.validate_every;
    while (tally_.edits < batch_.count) {
      begin_or_end_stroke();
      one();
      if (batch_.validate_every != 0 && tally_.edits >= next_check) { // a run of undos may have gone past it by a few
        check();
        next_check += batch_.validate_every;
      }
    }
  }

  void undo_and_redo_all(const test::Mesh_snapshot& input) {
    const test::Mesh_snapshot end = test::snapshot(sculptor_);
    ++tally_.histories;
    tally_.longest_history = sculptor_.history().number_of_undo_steps();
    while (sculptor_.undo())
      ;
    tally_.undo_differs += test::snapshot(sculptor_) != input;
    check();
    while (sculptor_.redo())
      ;
    tally_.redo_differs += test::snapshot(sculptor_) != end;
    check();
  }

  /// Half of the edits are in strokes, of ten on average; one that undo has ended is ended again.
  void begin_or_end_stroke() {
    if (places_.below(10) != 0)
      return;
    if (stroke_)
      return end_stroke();
    let_go_as_a_script_does("stroke");
    stroke_.emplace(sculptor_.stroke()), ++tally_.strokes;
  }

  void end_stroke() {
    if (stroke_)
      let_go_as_a_script_does("end");
    stroke_.reset();
  }

  /// Every line but a drag of the same vertex lets go. The Grab stays and takes its vertex anew, without contacts.
  void let_go_as_a_script_does(const char* word) {
    script_.add(word);
    sculptor_.release();
  }

  void one() {
    const std::size_t kind = places_.below(26);
    // Creations succeed more often than removals; this keeps the mesh from growing without end.
    const bool is_full = mesh_.number_of_vertices() > 2 * vertices_at_first_ + 100;
    if (kind < 6)
      drag();
    else if (kind < 9 && !is_full)
      create_on_face();
    else if (kind < 12 && !is_full)
      create_on_edge();
    else if (kind < 16)
      remove();
    else if (kind < 19)
      go_back();
    else if (kind < 20)
      redo();
    else if (kind < 22)
      collapse();
    else
      flip();
  }

  std::size_t id_of_source(Halfedge_index h) const { return sculptor_.id(mesh_.source(h)); }
  std::size_t id_of_target(Halfedge_index h) const { return sculptor_.id(mesh_.target(h)); }

  void remove() {
    const Vertex_index v = places_.vertex();
    script_.add("remove", {sculptor_.id(v)});
    count("remove", sculptor_.remove(v));
  }
  void collapse() {
    const Halfedge_index h = places_.halfedge();
    script_.add("collapse", {id_of_source(h), id_of_target(h)});
    count("collapse", sculptor_.collapse(h));
  }
  void flip() {
    const Halfedge_index h = places_.halfedge();
    script_.add("flip", {id_of_source(h), id_of_target(h)});
    count("flip", sculptor_.flip(mesh_.edge(h)));
  }
  void undo() {
    script_.add("undo");
    count("undo", sculptor_.undo());
  }
  void redo() {
    script_.add("redo");
    count("redo", sculptor_.redo());
  }

  /// A few steps back and, half of the time, some forth before a new edit clears them.
  void go_back() {
    for (std::size_t steps = 1 + places_.below(4); steps > 0; --steps)
      undo();
    for (std::size_t steps = places_.below(2) * (1 + places_.below(4)); steps > 0; --steps)
      redo();
  }

  void count(const char* kind, const Edited& edited) {
    bits_.add(std::uint64_t{edited ? 1u : 0u});
    tally_.count(kind, edited ? nullptr : name_of(edited.refusal->reason));
  }

  void drag() {
    const std::size_t kind = places_.below(8);
    // A grab may outlive its vertex; another vertex grabbed since lets go of it.
    if (!grab_ || !grab_->vertex().is_valid() || places_.below(3) == 0) {
      script_.add("release"); // it may be the same vertex, which is taken anew
      grab_.emplace(sculptor_.grab(places_.vertex()));
    }
    const Vertex_index v = grab_->vertex();
    const Point_3 target = kind < 3 ? places_.short_step(v) : kind < 5 ? places_.through(v) : places_.odd_target(v);
    const char* name = kind < 3 ? "drag, short" : kind < 5 ? "drag, through" : "drag, odd";
    script_.add("drag", {sculptor_.id(v)}, target);
    const auto result = grab_->drag_to(target);
    bits_.add(result);
    tally_.count(name, result.reached ? nullptr : "stopped short");
  }

  void create_on_face() {
    const Halfedge_index h = places_.halfedge();
    switch (places_.below(6)) {
    case 0: case 1: return create_on_face("insert_face inside", h, places_.inside_face(h));
    case 2: return create_on_face("insert_face near a corner", h, places_.near_corner(h));
    case 3: return create_on_face("insert_face on a corner", h, places_.corner(h));
    case 4: return create_on_face("insert_face on an edge", h, places_.on_edge(h));
    default: return create_on_face("insert_face off the face", h, places_.off_face(h));
    }
  }

  void create_on_face(const char* kind, Halfedge_index h, const Point_3& p) {
    script_.add("insert_face", {id_of_source(h), id_of_target(h), id_of_target(mesh_.next(h))}, p);
    create(kind, {h}, p, [&] { return sculptor_.insert_on_face(mesh_.face(h), p); });
  }

  void create_on_edge() {
    const Halfedge_index h = places_.halfedge();
    switch (places_.below(5)) {
    case 0: case 1: return create_on_edge("insert_edge inside", h, places_.on_edge(h));
    case 2: return create_on_edge("insert_edge near an end", h, places_.near_end(h));
    case 3: return create_on_edge("insert_edge on an end", h, places_.end(h));
    default: return create_on_edge("insert_edge off the edge", h, places_.off_face(h));
    }
  }

  void create_on_edge(const char* kind, Halfedge_index h, const Point_3& p) {
    script_.add("insert_edge", {id_of_source(h), id_of_target(h)}, p);
    create(kind, {h, mesh_.opposite(h)}, p, [&] { return sculptor_.insert_on_edge(mesh_.edge(h), p); });
  }

  /// Every refusal is judged by the independent decision, and one in `judged_share` before it is known what comes of
  /// it.
  template <class Make>
  void create(const char* kind, const std::vector<Halfedge_index>& old_halfedges, const Point_3& p, const Make& make) {
    if (batch_.has_only_bits)
      return count(kind, make());
    const bool is_judged = tally_.edits % judged_share == 0;
    const bool is_feasible = is_judged && is_feasible_creation(mesh_, old_halfedges, p);
    const Edited edited = make();
    count(kind, edited);
    if (edited)
      ++tally_.creations_done, tally_.creations_wrongly_accepted += is_judged && !is_feasible;
    else
      tally_.creations_wrongly_refused += is_judged ? is_feasible : is_feasible_creation(mesh_, old_halfedges, p);
    tally_.creations_judged += is_judged || !edited;
  }

  void check() {
    if (batch_.has_only_bits)
      return;
    ++tally_.validations;
    tally_.invalid += !mesh_.is_valid(false) || !validate(mesh_).is_valid();
    try {
      sculptor_.check_unchanged();
    } catch (const Mesh_changed&) {
      ++tally_.changed;
    }
  }
};

} // namespace haptic_sculpt::robustness
