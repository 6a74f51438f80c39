// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Tool_step.h>
#include <haptic_sculpt/haptic_rendering/exchange/Journaled_edits.h>
#include <haptic_sculpt/haptic_rendering/finding_and_placing.h>
#include <haptic_sculpt/haptic_rendering/loop/require_number.h>
#include <haptic_sculpt/haptic_rendering/tool/Probe_placement.h>

#include <utility>

namespace haptic_sculpt {

/// What a hand does in a scene: a probe that touches, a vertex that is grabbed, created, dragged, let go or removed.
///
/// Button 1 takes the nearest vertex in reach; else creates one where the probe touches a face or, near it, an edge.
/// Button 2 removes the vertex held, which it lets go of even where that is refused, or the nearest in reach. What
/// cannot be done is refused, and the mesh is as it was. Targets are anchored: at each change of what is held the
/// target is where that is, so no force begins; the offset fades where nothing is touched. A vertex held, from the
/// press of the button to its release, creation and removal included, is one stroke: one step of undo.
///
/// Beside the button, who has the loop's thread may hand it a vertex or the probe, begin a stroke, and make edits.
template <class Sculptor>
class Tool {
public:
  using Mesh = typename Sculptor::Mesh_type;        ///< of the surface
  using Vertex_index = typename Mesh::Vertex_index; ///< of a vertex
  using Point = typename Mesh::Point;               ///< in the scene
  using Grab_type = typename Sculptor::Grab_type;   ///< what holds the vertex
  using Probe_type = typename Sculptor::Probe_type; ///< what touches while no vertex is held
  using Edited = Applied<Mesh>;                     ///< what an edit gives
  using Result = typename Sculptor::Result;         ///< what a drag gives

  /// In free motion the offset of the target fades with this time, s.
  static constexpr double offset_time = 0.2;

  /// \param reach of a grab, in the device, m \param tick s \throw Error naming what cannot be used
  Tool(Sculptor& sculptor, const Workspace_map& map, double reach, double tick)
      : sculptor_(&sculptor)
      , map_(map)
      , reach_(reach)
      , offset_share_(offset_share(tick))
      , mesh_edits_(sculptor) {
    internal::require_reach("the reach of a Tool, that of a grab,", reach);
    internal::require_number("the tick of a Tool", "s", tick, 0, 1);
  }

  /// One tick: the button first, then the drag. A tick in which a vertex is taken in hand or let go of drags nothing,
  /// and one that looks for a place of the probe tries one place, too: no tick has the work of two. Allocates nothing
  /// but what edits do, and where coordinates are more than 2^199 apart in size; its work is that of the drag, bounded
  /// as its parameters say; unset: those of the Sculptor. Where a function of the caller's asks for it in the middle of
  /// a call, a change of the button waits. \throw what drags throw
  Tool_step move(const Eigen::Vector3d& handle, int button, const std::optional<Drag_parameters>& drag = std::nullopt) {
    const internal::Rounding_to_nearest rounding;
    const Eigen::Vector3d hand = map_.to_scene(handle);
    Tool_step step;
    if (grab_ && !holds_vertex()) // somebody beside the tool took or removed it
      mesh_edits_.is_asked() ? grab_.reset() : drop();
    const auto in_hand = [this] { return holds_vertex() ? grab_->vertex() : Vertex_index(); };
    const Vertex_index held = in_hand();
    step.event = press(hand, button);
    const bool has_changed_hands = in_hand() != held || step.event == Tool_event::grabbed;
    if (grab_ && !is_anchored_)
      anchor(place_of(grab_->vertex()), hand);
    const bool looks_for_place = placement_ && !has_changed_hands;
    if (looks_for_place)
      try_next_place(hand);
    else if (!grab_ && !placement_ && (carries_probe_ || probe_))
      bring_probe(hand);
    step.target = step.proxy = hand + offset_;
    last_drag_.reset();
    if (has_changed_hands || looks_for_place || (!grab_ && !probe_))
      return step;
    const Point target = internal::point_of<Point>(step.target);
    last_drag_ = grab_ ? mesh_edits_.drag(*grab_, target, drag) : probe_->drag_to(target, drag);
    tell(*last_drag_, step);
    if (step.reached && !grab_ && carries_probe_)
      offset_ *= offset_share_;
    return step;
  }

  /// Lets go of everything, as at a fault. The next move begins anew, anchored, with the probe; a button that is held
  /// does nothing until it is pressed again. \throw Reentrant_call, as all that changes what is in hand or which
  /// journal hears of it, where a function of the caller's asks for it in the middle of a call; nothing has changed
  /// then
  void let_go() {
    mesh_edits_.check_nobody_asks();
    drop();
  }

  /// \name Between two ticks
  /// In the thread that calls move(). Each lets go first; what is taken is anchored at the next move(), and held until
  /// something lets go: of a vertex the button, too, when it is released.
  ///@{

  /// Takes a vertex of the surface, as a press of the button would the nearest.
  void take(Vertex_index v) {
    const internal::Rounding_to_nearest rounding;
    begin_stroke();
    hold(v);
  }
  /// Makes a creation and takes the vertex, both in one stroke. Where it cannot be taken, as memory runs out, the
  /// creation stands as a step of its own. \pre its kind is one of the creations
  Edited create_and_take(const Edit& wanted) {
    const internal::Rounding_to_nearest rounding;
    let_go();
    auto made = mesh_edits_.make_in_stroke(wanted);
    if (made)
      hold(*made.vertex);
    return made;
  }
  /// Puts the probe somewhere, whatever is on the way, and takes it. \return false where that is not outside
  bool take_probe(const Eigen::Vector3d& place) {
    const internal::Rounding_to_nearest rounding;
    let_go();
    drop_probe();
    return put_probe(place);
  }
  /// Does an edit. \pre it is no stroke and no end
  Edited edit(const Edit& wanted) {
    const internal::Rounding_to_nearest rounding;
    let_go();
    return mesh_edits_.make(wanted);
  }
  /// What edit_by() does from here on is one step of undo, until something lets go, or the button takes,
  /// creates or removes what is there, be it refused.
  void begin_stroke() {
    let_go();
    mesh_edits_.begin_stroke();
  }
  /// Has a function make many edits, through what takes the place of a Sculptor: `function(edits)` may give it to
  /// move_vertices(), apply_brush(), move_rigidly() or isotropic_remeshing(). They are in the journal. One step of undo
  /// each, but a stroke under way goes on. \return what the function gives \throw what it throws
  template <class Function>
  auto edit_by(const Function& function) {
    mesh_edits_.check_nobody_asks();
    grab_.reset();
    is_anchored_ = is_anchored_ && carries_probe_;
    return function(mesh_edits_);
  }
  /// At first the probe is in hand wherever no vertex is. false: only from take_probe() until something lets go; one
  /// that is in hand already, or about to be, stays until then.
  void carry_probe(bool does) { carries_probe_ = does; }
  ///@}

  /// Lets go, and begins anew in another scene.
  void enter(Sculptor& sculptor, const Workspace_map& map) {
    let_go();
    drop_probe();
    sculptor_ = &sculptor, map_ = map;
    mesh_edits_.enter(sculptor);
    offset_.setZero(), last_push_ = Eigen::Vector3d::UnitZ();
  }

  /// From here on in another map of the same scene. What is held stays where it is, anchored at the next move().
  void change_map(const Workspace_map& map) { map_ = map, is_anchored_ = false, offset_.setZero(); }

  /// What is done from here on goes to it, nullptr: to none. Lets go where that is another one than before. \return a
  /// number that no other call has, for end_journal()
  std::uint64_t keep_journal(Edit_journal* journal) {
    if (journal != mesh_edits_.journal())
      let_go();
    mesh_edits_.keep_journal(journal);
    return ++journals_;
  }
  /// Ends what a call of keep_journal() began, unless another one has been made since. For destructors: lets go,
  /// whoever asks.
  void end_journal(std::uint64_t number) {
    if (number != journals_)
      return;
    if (mesh_edits_.journal() != nullptr)
      drop();
    mesh_edits_.keep_journal(nullptr);
    ++journals_;
  }

  bool holds_vertex() const { return vertex().is_valid(); }         ///< the probe does not count
  bool holds_probe() const { return !grab_ && probe_.has_value(); } ///< the probe is what is dragged
  /// That is held; null where none is.
  Vertex_index vertex() const { return grab_ ? grab_->vertex() : Vertex_index(); }
  const std::optional<Probe_type>& probe() const { return probe_; } ///< where there is one
  /// Where the vertex in hand is, or the probe; none where neither is there.
  std::optional<Eigen::Vector3d> place() const {
    if (holds_vertex())
      return place_of(vertex());
    return probe_ ? std::optional<Eigen::Vector3d>(internal::vector_of(probe_->position())) : std::nullopt;
  }
  const Tool_edits& edits() const { return edits_; } ///< of the button, in all scenes; edit() does not count
  /// What the drag of the last move() came to; none where it made none.
  const std::optional<Result>& last_drag() const { return last_drag_; }
  /// The push of the last contact, of length 1 in the scene; up where nothing was touched yet.
  const Eigen::Vector3d& last_push() const { return last_push_; }

private:
  Sculptor* sculptor_;
  Workspace_map map_;
  double reach_, offset_share_;     ///< m; a tick's
  std::optional<Grab_type> grab_;   ///< while a vertex is held
  std::optional<Probe_type> probe_; ///< never while a vertex is held
  bool is_anchored_ = false, carries_probe_ = true;
  int button_ = 0;
  bool is_stroke_of_button_ = false; ///< it ends with its release
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero(), last_push_ = Eigen::Vector3d::UnitZ();
  std::optional<std::array<Vertex_index, 3>> touched_; ///< the face that the probe touches
  std::uint64_t journals_ = 0;                         ///< calls of keep_journal()
  std::optional<internal::Probe_placement> placement_; ///< while the probe has no place since a vertex was let go
  Tool_edits edits_;
  Journaled_edits<Sculptor> mesh_edits_;
  std::optional<Result> last_drag_;

  double reach() const { return reach_ * map_.scale(); } ///< in the scene
  /// \throw Mesh_changed where others have left it fewer elements, maybe
  Eigen::Vector3d place_of(Vertex_index v) const {
    internal::Sculptor_access::guarded(*sculptor_).check_counts();
    return internal::vector_of(sculptor_->mesh().point(v));
  }
  void anchor(const Eigen::Vector3d& held, const Eigen::Vector3d& hand) { offset_ = held - hand, is_anchored_ = true; }

  /// From where things are sought that the hand wants.
  Eigen::Vector3d aim(const Eigen::Vector3d& hand) const {
    return place().value_or(placement_ ? placement_->place() : hand);
  }

  /// That is left of the offset after a tick.
  static double offset_share(double tick) {
    const internal::Rounding_to_nearest rounding;
    return internal::kept(std::exp(-tick / offset_time));
  }

  void drop() {
    const internal::Rounding_to_nearest rounding;
    grab_.reset();
    mesh_edits_.end_stroke();
    is_anchored_ = is_stroke_of_button_ = false;
    last_drag_.reset();
    if (!carries_probe_)
      drop_probe();
  }
  void drop_probe() { probe_.reset(), touched_.reset(), placement_.reset(); }

  /// Puts the probe to p. Returns false, and leaves it, where that is refused: on a face, or inside of a solid.
  bool put_probe(const Eigen::Vector3d& p) {
    auto probe = sculptor_->probe(internal::point_of<Point>(p));
    if (probe)
      probe_ = std::move(probe);
    return probe_.has_value();
  }

  /// One that a change of the mesh has ended goes on where it is, or a little off, if that is outside; else it comes to
  /// the hand.
  void bring_probe(const Eigen::Vector3d& hand) {
    if (probe_ && !*probe_) {
      const Eigen::Vector3d place = internal::vector_of(probe_->position());
      drop_probe();
      for (const double share : {0.0, 0.02}) // pressed on, it may be nearer to a face than a probe may begin
        if (!probe_)
          put_probe(internal::within_range(place + share * reach() * last_push_));
    }
    if (!probe_ && carries_probe_) {
      offset_.setZero();
      put_probe(hand);
    }
    if (probe_ && !is_anchored_)
      anchor(internal::vector_of(probe_->position()), hand);
  }

  void tell(const Result& result, Tool_step& step) {
    step.proxy = internal::vector_of(result.position);
    step.reached = result.reached;
    step.end = result.end;
    step.pairs = result.work;
    step.contacts = static_cast<int>(result.contacts.size());
    step.starved = result.contacts.empty() && (result.end == Drag_end::work_limit || result.end == Drag_end::leg_limit);
    if (!grab_)
      touched_.reset();
    for (const auto& contact : result.contacts) {
      const Eigen::Vector3d normal(contact.normal[0], contact.normal[1], contact.normal[2]);
      step.span.add(map_.direction_to_device(normal));
      last_push_ = normal;
      if (grab_)
        step.obstacle = sculptor_->id(contact.vertices[2]);
      if (!grab_ && contact.kind == Contact_kind::vertex_face)
        touched_ = contact.vertices;
    }
  }

  Tool_event press(const Eigen::Vector3d& hand, int button) {
    if (button == button_ || mesh_edits_.is_asked()) // then it waits
      return Tool_event::none;
    button_ = button;
    if (button == 1)
      return counted(grab_or_create(hand));
    const Tool_event released = grab_ && button == 0 ? release() : Tool_event::none;
    if (button == 0 && std::exchange(is_stroke_of_button_, false))
      mesh_edits_.end_stroke(); // of a vertex that was taken out of the hand, too
    return counted(button == 2 ? remove(hand) : released);
  }

  Tool_event counted(Tool_event event) {
    edits_.grabbed += event == Tool_event::grabbed;
    edits_.created += event == Tool_event::created_on_face || event == Tool_event::created_on_edge;
    edits_.released += event == Tool_event::released;
    edits_.removed += event == Tool_event::removed;
    edits_.refused += event == Tool_event::refused;
    return event;
  }

  Tool_event grab_or_create(const Eigen::Vector3d& hand) {
    const Vertex_index nearest = internal::nearest_vertex(*sculptor_, aim(hand), reach());
    if (nearest.is_valid()) {
      mesh_edits_.begin_stroke();
      is_stroke_of_button_ = true;
      hold(nearest);
      return Tool_event::grabbed;
    }
    if (!touched_ || !*probe_)
      return Tool_event::refused;
    const Edit wanted = creation_at(*sculptor_, *touched_, aim(hand));
    const auto made = mesh_edits_.make_in_stroke(wanted);
    if (!made)
      return Tool_event::refused;
    is_stroke_of_button_ = true;
    hold(*made.vertex);
    return wanted.kind == Edit_kind::insert_on_edge ? Tool_event::created_on_edge : Tool_event::created_on_face;
  }

  /// From the next move() on.
  void hold(Vertex_index v) {
    or_let_go([&] {
      drop_probe();
      grab_.emplace(sculptor_->grab(v));
    });
    is_anchored_ = false;
  }

  /// Where the function throws, the stroke of what is, or was to be, in hand ends.
  template <class Function>
  auto or_let_go(const Function& function) {
    try {
      return function();
    } catch (...) {
      drop();
      throw;
    }
  }

  Tool_event release() {
    const Vertex_index v = grab_->vertex();
    const Eigen::Vector3d place = or_let_go([&] { return place_of(v); }),
                          away = internal::vector_of(vertex_normal(sculptor_->mesh(), v));
    grab_.reset();
    mesh_edits_.end_stroke();
    if (carries_probe_)
      placement_.emplace(place, away);
    return Tool_event::released;
  }

  /// Tries the next place of the probe. In the end bring_probe() has to do.
  void try_next_place(const Eigen::Vector3d& hand) {
    if (const auto place = placement_->next(*sculptor_, reach(), map_.scale(), last_push_))
      put_probe(*place);
    if (probe_)
      anchor(internal::vector_of(probe_->position()), hand);
    if (probe_ || placement_->is_over())
      placement_.reset();
  }

  Tool_event remove(const Eigen::Vector3d& hand) {
    const Vertex_index v = grab_ ? grab_->vertex() : internal::nearest_vertex(*sculptor_, aim(hand), reach());
    if (!v.is_valid())
      return Tool_event::refused;
    const Eigen::Vector3d place = or_let_go([&] { return place_of(v); }),
                          away = internal::vector_of(vertex_normal(sculptor_->mesh(), v));
    const bool was_held = grab_.has_value();
    grab_.reset();
    const auto made = or_let_go([&] {
      return mesh_edits_.make(Edit::of(Edit_kind::remove, {sculptor_->id(v), 0, 0}));
    });
    mesh_edits_.end_stroke();
    if (was_held && carries_probe_)
      placement_.emplace(place, away);
    return made ? Tool_event::removed : Tool_event::refused;
  }
};

} // namespace haptic_sculpt
