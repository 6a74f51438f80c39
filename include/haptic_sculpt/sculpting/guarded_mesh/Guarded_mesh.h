// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/sculpting/contact/Scene_bound.h>
#include <haptic_sculpt/sculpting/edits/Editor.h>
#include <haptic_sculpt/sculpting/finding/Surface_finder.h>
#include <haptic_sculpt/sculpting/contact/check_arguments.h>
#include <haptic_sculpt/sculpting/guarded_mesh/Axis_move_at_hand.h>
#include <haptic_sculpt/sculpting/guarded_mesh/Hand.h>
#include <haptic_sculpt/sculpting/guarded_mesh/Inside_out_vertices.h>
#include <haptic_sculpt/sculpting/guarded_mesh/Probe_at_hand.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <limits>
#include <new>

namespace haptic_sculpt::internal {

/// A mesh with all that guards it, and the ways of a drag, a probe, a search and an edit through that. What its users
/// see of it is the Sculptor, which says what each operation promises.
template <class Mesh, class Broad_phase, class Visitor, class Traits>
class Guarded_mesh {
public:
  using Point = typename Mesh::Point;
  using Vertex_index = typename Mesh::Vertex_index;
  using Result = Drag_result<Mesh>;
  using Edited = Edit_result<Mesh>;

  /// \param make_traits is called with the counters, which the traits may refer to; the last argument lives as long as
  /// this takes
  template <class Make_traits>
  Guarded_mesh(Mesh& mesh, const Sculptor_parameters& parameters, Visitor visitor, const Make_traits& make_traits,
               const Rounding_to_nearest& /*rounding*/)
      : parameters(parameters)
      , mesh_(&mesh)
      , watch_(mesh)
      , broad_phase_(checked_scene(mesh, parameters))
      , corners_(mesh)
      , editor_(mesh, broad_phase_, corners_, counters_, watch_, writing_, std::move(visitor))
      , hand_(mesh, broad_phase_, corners_, make_traits(counters_), watch_)
      , question_(mesh, broad_phase_, corners_, make_traits(counters_), watch_)
      , probe_(mesh, broad_phase_, corners_, make_traits(counters_), watch_, counters_)
      , finder_(mesh, broad_phase_, corners_, counters_)
      , scene_(mesh)
      , shifting_(mesh, counters_)
      , inside_out_(mesh) {}
  Guarded_mesh(const Guarded_mesh&) = delete; // its parts refer to each other
  Guarded_mesh& operator=(const Guarded_mesh&) = delete;

  Sculptor_parameters parameters; ///< to be changed by the Sculptor, which checks them

  const Mesh& mesh() const { return *mesh_; }
  const Filter_counters& counters() const { return counters_; }
  auto& editor() { return editor_; }
  const auto& editor() const { return editor_; }
  /// To change it. \throw Reentrant_call, Unfinished_change
  auto& whole_editor() {
    check_may_change();
    return editor_;
  }
  /// \throw Unfinished_change
  const auto& whole_editor() const {
    check_is_whole();
    return editor_;
  }

  bool is_whole() const noexcept { return !writing_.is_under_way(); }
  /// \throw Unfinished_change if a change was broken off: every way in begins with this.
  void check_is_whole() const { writing_.check(); }
  /// The same of ways in that change anything. \throw Reentrant_call within a function of the caller's
  void check_may_change() const { writing_.check_may_change(); }
  /// The same, and no element has come or gone: numbers of vertices are good. \throw Mesh_changed, too
  void check_may_begin() const {
    check_may_change();
    watch_.check_counts();
  }
  /// The same of ways in that change nothing. \throw Unfinished_change, Mesh_changed
  void check_counts() const {
    check_is_whole();
    watch_.check_counts();
  }
  /// Whether a function of the caller's runs now, in the middle of a call.
  bool is_asking() const noexcept { return writing_.is_asking(); }
  /// In the middle of a call, as long as what is returned lives: functions of the caller's may look, and not edit.
  Write_state::Asking asking() { return Write_state::Asking(writing_); }

  void release() {
    const Rounding_to_nearest rounding; // the broad phase learns where a vertex is
    check_may_change();
    hand_.release();
    probe_.let_go();
  }
  void let_go() noexcept { hand_.let_go(); }

  /// \pre arithmetic rounds to nearest \throw Unknown_vertex, Mesh_changed
  void hold(Vertex_index v, bool once) {
    check_is_whole();
    if (v.is_valid() && hand_.holds(v, once)) // which compares counts
      return;
    watch_.check_counts();
    check_vertex(*mesh_, v);
    hand_.take(v, once, [this] { editor_.prepare_for_moves(); });
  }
  /// The same anew: without contacts, whoever is held.
  void grab(Vertex_index v) {
    check_may_begin();
    check_vertex(*mesh_, v);
    probe_.let_go();
    hand_.take(v, false, [this] { editor_.prepare_for_moves(); });
  }

  Result drag(Vertex_index v, const Point& target, std::vector<Point>* path,
              const std::optional<Drag_parameters>& given) {
    const Rounding_to_nearest rounding;
    check_may_change();
    check_point("the target", target);
    const Drag_parameters& drag = given ? *given : parameters.drag;
    check_serves(drag.clearance_length);
    hold(v, drag.is_once);
    editor_.make_room_for_move();
    const Coordinates s = vertex_coordinates(*mesh_, v), t = coordinates(target);
    Result result;
    settle_result(s, t, t, result); // where there is no way to go
    const Coordinates end = s == t ? t : hand_.move(s, t, drag, parameters.delta_length, result);
    if (path != nullptr)
      hand_.write_path(s, end, *path);
    hand_.check_candidates();
    if (end != s)
      put(v, s, end);
    return result;
  }

  /// Whether the scene has outgrown the clearance of drags that are given none.
  bool has_outgrown_clearance() { return scene_.has_outgrown(parameters.drag.clearance_length); }
  /// \throw Invalid_parameter where that is so
  void check_clearance_serves() { check_serves(parameters.drag.clearance_length); }

  bool move_if_free(Vertex_index v, const Point& target, const std::optional<Drag_parameters>& given, double delta) {
    const Rounding_to_nearest rounding;
    check_may_change();
    check_point("the target", target);
    const Drag_parameters& drag = given ? *given : parameters.drag;
    hold(v, drag.is_once);
    editor_.make_room_for_move();
    const Coordinates s = vertex_coordinates(*mesh_, v), t = coordinates(target);
    if (s == t)
      return true;
    const bool is_free = hand_.is_free(s, t, drag, delta);
    hand_.check_candidates();
    if (is_free)
      put(v, s, t);
    return is_free;
  }

  auto first_impact(Vertex_index v, const Point& target) {
    const Rounding_to_nearest rounding;
    check_point("the target", target);
    check_is_whole();
    watch_.check_counts();
    check_vertex(*mesh_, v);
    hand_.tell_where_it_is();
    if (std::exchange(asked_at_, changes()) != changes())
      question_.let_go();
    if (!question_.holds(v, false))
      question_.take(v, false, [] {});
    const auto first = question_.first_impact(vertex_coordinates(*mesh_, v), coordinates(target));
    question_.check_candidates();
    return first;
  }

  /// Grows with each change of the mesh.
  std::uint64_t changes() const { return writing_.changes(); }

  /// Why no probe may begin at p; nothing where one may.
  std::optional<Refusal<Mesh>> refuse_probe(const Point& p, Probe_start start) {
    const Rounding_to_nearest rounding;
    check_point("the place of the probe", p);
    look_at_surface();
    const std::optional<double>& clearance = parameters.drag.clearance_length;
    check_serves(clearance);
    return probe_.refuse(coordinates(p), start, Clearance_rule(clearance), scene_.largest_coordinate());
  }

  /// Sweeps a point.
  Result drag_probe(const Point& source, const Point& target, std::vector<Point>* path,
                    const std::optional<Drag_parameters>& given) {
    const Rounding_to_nearest rounding;
    check_point("the target", target);
    check_is_whole();
    watch_.check_counts();
    hand_.tell_where_it_is();
    const Drag_parameters& drag = given ? *given : parameters.drag;
    check_serves(drag.clearance_length);
    return probe_.drag(coordinates(source), coordinates(target), path, drag, parameters.delta_length, changes());
  }

  Vertex_index nearest_vertex(const Point& p, double within) {
    const Rounding_to_nearest rounding;
    check_point("the point", p);
    if (!(within >= 0))
      throw Invalid_parameter("the distance within which a vertex is sought must be >= 0, not " + number(within));
    look_at_surface();
    const Vertex_index v = finder_.nearest_vertex(coordinates(p), within);
    if (v.is_valid())
      watch_.check(v);
    return v;
  }

  bool is_inside_out(Vertex_index v) {
    const Rounding_to_nearest rounding;
    look_at_surface();
    check_vertex(*mesh_, v);
    if (writing_.is_asking()) // within an undo of many changes no state on the way need be embedded
      return Inside_out_vertices<Mesh>(*mesh_).contain(v);
    return inside_out_.contain(v);
  }

  std::optional<Surface_hit<Mesh>> first_hit(const Point& source, const Point& target) {
    const Rounding_to_nearest rounding;
    check_point("the source", source);
    check_point("the target", target);
    look_at_surface();
    const auto hit = finder_.first_hit(coordinates(source), coordinates(target));
    if (hit)
      for (const Vertex_index v : corners_(hit->face))
        watch_.check(v);
    return hit;
  }

  /// A vertex is to be created at p by the edit under way. \pre within edited()
  void expect_vertex(const Coordinates& p) { scene_.expect(p); }

  /// Runs an edit between looking for changes by others and noting what it changed.
  template <class Edit_function>
  Edited edited(const Edit_function& edit) {
    const Rounding_to_nearest rounding;
    release();
    look_for_changes();
    shifting_.forget();
    inside_out_.forget();
    const Forget_at_end forget{*this};
    const std::uint64_t before = changes();
    try {
      const Edited result = edit();
      if (result)
        scene_.include(vertex_coordinates(*mesh_, *result.vertex));
      return result;
    } catch (...) {
      if (changes() != before) // the edit stands
        scene_.include_all();
      throw;
    }
  }
  /// The same where many vertices may move.
  template <class Edit_function>
  Edited restored(const Edit_function& edit) {
    scene_.include_the_past();
    const Edited made = edited(edit);
    scene_.include_the_past(); // a question on the way may have bounded what was there then
    return made;
  }

  /// Has axis moves look at what they may meet from here on: as Axis_move_at_hand::look_around().
  void look_around(const Vertex_targets<Mesh>& targets) {
    const Rounding_to_nearest rounding;
    release();
    look_for_changes();
    shifting_.look_around(broad_phase_, targets);
  }

  /// Moves vertices at once along one axis as far as that is free, as one change; each vertex is given once.
  /// \pre look_around() was called for them, and nothing else has moved since
  /// \param run who shares the work \param work of what may be decided, where it is not null \return false where more
  /// than `most_held` would be held back, or more be decided: then nothing has changed, and axis_move() knows why
  /// \throw Mesh_changed
  bool shift(int axis, const Axis_ways<Mesh>& ways, std::size_t most_held, const Part_runner& run,
             Pair_budget* work = nullptr) {
    const Rounding_to_nearest rounding;
    release();
    look_for_changes();
    shifting_.check_unmoved(watch_);
    Axis_move<Mesh>& move = axis_move();
    move.begin(axis, ways, parameters.delta_length, run, most_held, work);
    if (!move.hold_back())
      return false;
    const Axis_ways<Mesh> made = shifting_.made_ways(axis, ways);
    for (const auto& [v, end] : made) {
      Coordinates p = vertex_coordinates(*mesh_, v);
      p[axis] = end;
      scene_.include(p);
    }
    if (!made.empty())
      editor_.shift(axis, made, run);
    return true;
  }
  /// \name What is tried: what is taken back before the end is not noted, and clears nothing that could be redone
  ///@{
  void begin_trial() { editor_.history().begin_trial(); }
  void end_trial() noexcept { editor_.history().end_trial(); }
  std::size_t tried_shifts() const { return editor_.history().tried_shifts(); }
  /// The last shift back, which is free: no state of it is another. \pre nothing else has moved since
  void take_back_tried_shift(const Part_runner& run) {
    const Rounding_to_nearest rounding;
    release();
    look_for_changes();
    shifting_.check_unmoved(watch_);
    scene_.include_the_past(); // a question since then may have bounded what is there now
    editor_.take_back_tried_shift(run);
  }
  /// Whether the visitor hears of edits.
  void tell_visitor(bool does) { editor_.tell_visitor(does); }
  ///@}
  /// The last one.
  Axis_move<Mesh>& axis_move() { return shifting_.move(); }
  /// All that is in the way of a motion, not only what was found until it was given up. \pre as of shift()
  const std::vector<Axis_obstacle>& obstacles_to(int axis, const Axis_ways<Mesh>& ways, const Part_runner& run,
                                                 Pair_budget* work = nullptr) {
    const Rounding_to_nearest rounding;
    axis_move().begin(axis, ways, parameters.delta_length, run, std::numeric_limits<std::size_t>::max(), work);
    return axis_move().sorted_obstacles();
  }

  void reserve(std::size_t edits, std::size_t moves) {
    check_may_change();
    if (edits > std::numeric_limits<typename Mesh::size_type>::max() || moves > most_moves)
      throw std::bad_alloc();
    std::size_t valence = Star_runs<Mesh>::most_undivided;
    for (const Vertex_index v : mesh_->vertices())
      valence = std::max(valence, static_cast<std::size_t>(mesh_->degree(v)));
    const std::size_t candidates = usual_candidates + 2 * valence;
    editor_.reserve(edits, moves, valence, candidates);
    hand_.reserve(valence, candidates);
    question_.reserve(valence, candidates);
    probe_.reserve(valence, candidates);
  }

  void check_unchanged() const {
    const Rounding_to_nearest rounding; // points that differ by a subnormal number differ
    check_is_whole();
    watch_.check_all(corners_);
  }
  std::size_t memory() const {
    return broad_phase_.memory() + corners_.memory() + watch_.memory() + editor_.ids().memory() + shifting_.memory() +
           inside_out_.memory();
  }

private:
  /// More faces about a star than a drag of default bound looks up, and than an edit of a vertex drawn far out as a
  /// rule.
  static constexpr std::size_t usual_candidates = 2048;
  static constexpr std::size_t most_moves = std::size_t{1} << 40; ///< more than there is memory to note

  Mesh* mesh_;
  Write_state writing_;
  Mesh_watch<Mesh> watch_;
  Filter_counters counters_;
  Broad_phase broad_phase_;
  Face_corners<Mesh> corners_;
  Editor<Mesh, Broad_phase, Visitor> editor_;
  Hand<Mesh, Broad_phase, Traits> hand_,
      question_; ///< of first_impact(): what the hand has looked up, and where its search is, stays
  std::uint64_t asked_at_ = 0; ///< changes() by the last question
  Probe_at_hand<Mesh, Broad_phase, Traits> probe_;
  Surface_finder<Mesh, Broad_phase> finder_;
  Scene_bound<Mesh> scene_;
  Axis_move_at_hand<Mesh> shifting_;
  Inside_out_vertices<Mesh> inside_out_;

  /// What a visitor has asked for within a change was looked up in a mesh on its way: it is not used on.
  struct Forget_at_end {
    Guarded_mesh& mesh;
    ~Forget_at_end() { mesh.hand_.let_go(), mesh.probe_.let_go(), mesh.scene_.expect_none(); }
  };

  void check_serves(const std::optional<double>& clearance) {
    scene_.check_clearance_serves(clearance, parameters.drag.clearance_length);
  }

  /// For questions about the surface: lets nobody go.
  void look_at_surface() {
    check_is_whole();
    hand_.tell_where_it_is();
    look_for_changes();
  }

  void look_for_changes() {
    watch_.check_counts();
    watch_.check_some();
  }

  /// The one place where a drag writes the mesh. Whatever the response has proposed: each leg has been proven by the
  /// sweeps, which take no end that is not in range. Nothing is allocated: room to note the move was made before it was
  /// decided.
  void put(Vertex_index v, const Coordinates& from, const Coordinates& to) {
    if (!is_in_range(to))
      throw Error("a drag would have ended out of range: this is a fault of haptic_sculpt, the mesh is as it was");
    writing_.begin();
    mesh_->point(v) = Point(to[0], to[1], to[2]);
    watch_.remember(v);
    scene_.include(to);
    hand_.note_moved();
    editor_.note_move(v, from, to);
    writing_.end();
    editor_.tell_moved(v);
  }
};

} // namespace haptic_sculpt::internal
