// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Edit_tally.h"
#include "Random_places.h"
#include "is_feasible_creation.h"
#include "sculpting/Mesh_snapshot.h"

#include <optional>

namespace haptic_sculpt::robustness {

/// One batch of drags, creations, removals, collapses, flips, undo and redo mixed, part of them in strokes, on a fresh
/// copy of the mesh; in the end all is undone, which has to give the input bit for bit, and redone, which has to give
/// the end.
class Edit_batch {
public:
  /// \param validate_every 0: only in the end, undone, and redone
  Edit_batch(const Mesh& mesh, Response response, std::uint64_t seed, std::size_t validate_every)
      : mesh_(mesh)
      , sculptor_(mesh_, parameters::response(response))
      , places_(mesh_, seed)
      , validate_every_(validate_every)
      , vertices_at_first_(mesh.number_of_vertices()) {}

  Edit_tally run(std::size_t edits) {
    const test::Mesh_snapshot input = test::snapshot(sculptor_);
    std::size_t next_check = validate_every_;
    while (tally_.edits < edits) {
      begin_or_end_stroke();
      one();
      if (validate_every_ != 0 && tally_.edits >= next_check) { // a run of undos may have gone past it by a few
        check();
        next_check += validate_every_;
      }
    }
    stroke_.reset();
    check();
    while (sculptor_.redo())
      ;
    const test::Mesh_snapshot end = test::snapshot(sculptor_);
    tally_.longest_history = sculptor_.history().number_of_undo_steps();
    while (sculptor_.undo())
      ;
    tally_.undo_differs += test::snapshot(sculptor_) != input;
    check();
    while (sculptor_.redo())
      ;
    tally_.redo_differs += test::snapshot(sculptor_) != end;
    check();
    return tally_;
  }

private:
  static constexpr std::size_t judged_share = 16; ///< the decision is linear in the mesh

  using Edited = Edit_result<Mesh>;

  Mesh mesh_;
  Sculptor<Mesh> sculptor_;
  Random_places places_;
  std::size_t validate_every_, vertices_at_first_;
  std::optional<Grab<Sculptor<Mesh>>> grab_; ///< kept in hand while other edits go on
  std::optional<Stroke<Sculptor<Mesh>>> stroke_;
  Edit_tally tally_;

  /// Half of the edits are in strokes, of ten on average; one that undo has ended is ended again.
  void begin_or_end_stroke() {
    if (places_.below(10) != 0)
      return;
    if (stroke_)
      stroke_.reset();
    else
      stroke_.emplace(sculptor_.stroke()), ++tally_.strokes;
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
      count("remove", sculptor_.remove(places_.vertex()));
    else if (kind < 19)
      go_back();
    else if (kind < 20)
      count("redo", sculptor_.redo());
    else if (kind < 22)
      count("collapse", sculptor_.collapse(places_.halfedge()));
    else
      count("flip", sculptor_.flip(mesh_.edge(places_.halfedge())));
  }

  /// A few steps back and, half of the time, some forth before a new edit clears them.
  void go_back() {
    for (std::size_t steps = 1 + places_.below(4); steps > 0; --steps)
      count("undo", sculptor_.undo());
    for (std::size_t steps = places_.below(2) * (1 + places_.below(4)); steps > 0; --steps)
      count("redo", sculptor_.redo());
  }

  void count(const char* kind, const Edited& edited) {
    tally_.count(kind, edited ? nullptr : name_of(edited.refusal->reason));
  }

  void drag() {
    const std::size_t kind = places_.below(8);
    // A grab may outlive its vertex; another vertex grabbed since lets go of it.
    if (!grab_ || !grab_->vertex().is_valid() || places_.below(3) == 0)
      grab_.emplace(sculptor_.grab(places_.vertex()));
    const Vertex_index v = grab_->vertex();
    const Point_3 target = kind < 3 ? places_.short_step(v) : kind < 5 ? places_.through(v) : places_.odd_target(v);
    const char* name = kind < 3 ? "drag, short" : kind < 5 ? "drag, through" : "drag, odd";
    tally_.count(name, grab_->drag_to(target).reached ? nullptr : "stopped short");
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
    create(kind, {h, mesh_.opposite(h)}, p, [&] { return sculptor_.insert_on_edge(mesh_.edge(h), p); });
  }

  /// Every refusal is judged by the independent decision, and one in `judged_share` before it is known what comes of
  /// it.
  template <class Make>
  void create(const char* kind, const std::vector<Halfedge_index>& old_halfedges, const Point_3& p, const Make& make) {
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
