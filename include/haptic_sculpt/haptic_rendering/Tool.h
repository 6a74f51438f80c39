// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_TOOL_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_TOOL_H

#include <haptic_sculpt/haptic_rendering/Tool_step.h>
#include <haptic_sculpt/haptic_rendering/exchange/Journaled_edits.h>
#include <haptic_sculpt/haptic_rendering/finding_and_placing.h>

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
  using Mesh = typename Sculptor::Mesh_type;        ///< the mesh of surface and probe
  using Vertex_index = typename Mesh::Vertex_index; ///< of a vertex, or of the probe
  using Point = typename Mesh::Point;               ///< in the scene
  using Grab_type = typename Sculptor::Grab_type;   ///< what holds the vertex, or the probe
  using Edited = typename Sculptor::Edited;         ///< what an edit gives
  using Result = typename Sculptor::Result;         ///< what a drag gives

  /// In free motion the offset of the target fades with this time, s.
  static constexpr double offset_time = 0.2;

  /// \param probe an isolated vertex outside of all solids \param reach of a grab, in the device, m
  Tool(Sculptor& sculptor, Vertex_index probe, const Workspace_map& map, double reach, double tick)
      : sculptor_(&sculptor)
      , probe_(probe)
      , map_(map)
      , reach_(reach * map.scale())
      , offset_share_(std::exp(-tick / offset_time))
      , mesh_edits_(sculptor, probe) {}

  /// One tick: the button first, then the drag. Allocates nothing but what edits do; its work is that of the drag,
  /// bounded by the Sculptor. \throw what drags throw
  Tool_step move(const Eigen::Vector3d& handle, int button) {
    const internal::Rounding_to_nearest rounding;
    const Eigen::Vector3d hand = map_.to_scene(handle);
    Tool_step step;
    if (!is_started_)
      start(hand);
    step.event = press(hand, button);
    if (grab_ && !is_anchored_)
      anchor(grab_->vertex(), hand);
    if (!grab_ && carries_probe_)
      bring_probe(hand);
    step.target = step.proxy = hand + offset_;
    last_drag_.reset();
    if (!grab_)
      return step;
    const Point target = internal::point_of<Point>(step.target);
    last_drag_ = held_ ? mesh_edits_.drag(*grab_, target) : grab_->drag_to(target);
    tell(*last_drag_, step);
    if (step.reached && !held_ && carries_probe_)
      offset_ *= offset_share_;
    return step;
  }

  /// Lets go of everything, as at a fault. The next move begins anew, anchored, with the probe; a button that is held
  /// does nothing until it is pressed again.
  void let_go() {
    const internal::Rounding_to_nearest rounding;
    grab_.reset();
    mesh_edits_.end_stroke();
    held_ = false, is_anchored_ = false;
    last_drag_.reset();
    if (!carries_probe_)
      park_probe(last_push_);
  }

  /// \name Between two ticks
  /// In the thread that calls move(). Each lets go first; what is taken is anchored at the next move(), and held until
  /// the button is released or something lets go.
  ///@{

  /// Takes a vertex of the surface, as a press of the button would the nearest.
  void take(Vertex_index v) {
    const internal::Rounding_to_nearest rounding;
    begin_stroke();
    hold(v, internal::vertex_normal(sculptor_->mesh(), v));
  }
  /// Makes a creation and takes the vertex, both in one stroke. \pre its kind is one of the creations
  Edited create_and_take(const Journal_entry& wanted) {
    const internal::Rounding_to_nearest rounding;
    let_go();
    const Eigen::Vector3d away = last_push_;
    Parked_probe parked(*this);
    auto made = mesh_edits_.make_in_stroke(wanted);
    if (made)
      parked.stays(), hold(*made.vertex, away);
    return made;
  }
  /// Puts the probe somewhere, whatever is on the way, and takes it. \return false where that is not outside
  bool take_probe(const Eigen::Vector3d& place) {
    const internal::Rounding_to_nearest rounding;
    let_go();
    is_started_ = true;
    is_probe_placed_ = internal::put_probe(*sculptor_, probe_, place);
    if (is_probe_placed_)
      grab_.emplace(sculptor_->grab(probe_));
    return is_probe_placed_;
  }
  /// Does an edit: an undo or redo, a creation, removal, collapse or flip. The probe is out of its way meanwhile.
  /// \param wanted with `Sculptor::name()`s \pre its kind is one of these
  Edited edit(const Journal_entry& wanted) {
    const internal::Rounding_to_nearest rounding;
    let_go();
    const Parked_probe parked(*this);
    return mesh_edits_.make(wanted);
  }
  /// What move_many() does from here on is one step of undo, until something lets go.
  void begin_stroke() {
    let_go();
    mesh_edits_.begin_stroke();
  }
  /// Moves many vertices as near to their targets as straight ways lead (move_vertices()). A stroke under way goes on.
  /// The Sculptor's visitor has to be a Scene_teller. \throw what move_vertices() throws
  template <class Vertex_range, class Target_map>
  Move_report move_many(const Vertex_range& vertices, const Target_map& targets) {
    grab_.reset();
    held_ = false, is_anchored_ = is_anchored_ && carries_probe_;
    return mesh_edits_.move_many(vertices, targets);
  }
  /// At first the probe is in hand wherever no vertex is. false: only from take_probe() until something lets go, and
  /// far away else.
  void carry_probe(bool does) { carries_probe_ = does; }
  ///@}

  /// Lets go, and begins anew in another scene.
  void enter(Sculptor& sculptor, Vertex_index probe, const Workspace_map& map) {
    let_go();
    reach_ *= map.scale() / map_.scale();
    sculptor_ = &sculptor, probe_ = probe, map_ = map;
    mesh_edits_.enter(sculptor, probe);
    offset_.setZero(), last_push_ = Eigen::Vector3d::UnitZ(), touched_.reset();
    is_started_ = is_probe_placed_ = false;
  }

  /// What is done from here on is told to it. nullptr: to none
  void keep_journal(Edit_journal* journal) { mesh_edits_.keep_journal(journal); }

  bool holds_vertex() const { return held_; }          ///< one of the surface; the probe does not count
  bool holds_probe() const { return grab_ && !held_; } ///< the probe is what is dragged
  /// What is dragged: the vertex held, or the probe; null where there is none.
  Vertex_index vertex() const { return grab_ ? grab_->vertex() : Vertex_index(); }
  Vertex_index probe() const { return probe_; }      ///< the isolated vertex that was given
  const Tool_edits& edits() const { return edits_; } ///< of the button, in all scenes; edit() does not count
  /// What the drag of the last move() came to; none where it made none.
  const std::optional<Result>& last_drag() const { return last_drag_; }
  /// The push of the last contact, of length 1 in the scene; up where nothing was touched yet.
  const Eigen::Vector3d& last_push() const { return last_push_; }

private:
  /// The probe is out of the way of an edit as long as this lives, and then where it was, also where the edit throws.
  class Parked_probe {
  public:
    explicit Parked_probe(Tool& tool)
        : tool_(tool), place_(tool.place_of(tool.probe_)), comes_back_(tool.is_probe_placed_) {
      tool.park_probe(tool.last_push_);
    }
    ~Parked_probe() noexcept(false) { // put_probe() throws where the mesh was changed by others
      if (comes_back_)
        tool_.is_probe_placed_ = internal::put_probe(*tool_.sculptor_, tool_.probe_, place_);
    }
    Parked_probe(const Parked_probe&) = delete;
    Parked_probe& operator=(const Parked_probe&) = delete;
    void stays() { comes_back_ = false; } // something else is in hand

  private:
    Tool& tool_;
    Eigen::Vector3d place_;
    bool comes_back_;
  };

  Sculptor* sculptor_;
  Vertex_index probe_;
  Workspace_map map_;
  double reach_, offset_share_;
  std::optional<Grab_type> grab_;
  bool held_ = false, is_started_ = false, is_anchored_ = false, is_probe_placed_ = false, carries_probe_ = true;
  int button_ = 0;
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero(), last_push_ = Eigen::Vector3d::UnitZ();
  std::optional<std::array<Vertex_index, 3>> touched_; ///< the face that the probe touches
  Tool_edits edits_;
  Journaled_edits<Sculptor> mesh_edits_;
  std::optional<Result> last_drag_;

  Eigen::Vector3d place_of(Vertex_index v) const { return internal::vector_of(sculptor_->mesh().point(v)); }
  void anchor(Vertex_index v, const Eigen::Vector3d& hand) { offset_ = place_of(v) - hand, is_anchored_ = true; }

  void start(const Eigen::Vector3d& hand) {
    is_started_ = true;
    is_probe_placed_ = carries_probe_ && internal::put_probe(*sculptor_, probe_, hand);
  }

  /// Without a vertex the probe is in hand, if it is anywhere.
  void bring_probe(const Eigen::Vector3d& hand) {
    if (!is_probe_placed_) {
      offset_.setZero();
      is_probe_placed_ = internal::put_probe(*sculptor_, probe_, hand);
    }
    if (!is_probe_placed_)
      return;
    if (!is_anchored_)
      anchor(probe_, hand);
    grab_.emplace(sculptor_->grab(probe_));
  }

  void tell(const Result& result, Tool_step& step) {
    step.proxy = internal::vector_of(result.position);
    step.reached = result.reached;
    step.end = result.end;
    step.pairs = result.work;
    step.contacts = static_cast<int>(result.contacts.size());
    step.starved =
        result.contacts.empty() && (result.end == Drag_end::work_limit || result.end == Drag_end::leg_limit);
    if (!held_)
      touched_.reset();
    for (const auto& contact : result.contacts) {
      const Eigen::Vector3d normal(contact.normal[0], contact.normal[1], contact.normal[2]);
      step.span.add(map_.direction_to_device(normal));
      last_push_ = normal;
      if (held_)
        step.obstacle = sculptor_->name(contact.vertices[2]);
      if (!held_ && contact.kind == Contact_kind::vertex_face)
        touched_ = contact.vertices;
    }
  }

  Tool_event press(const Eigen::Vector3d& hand, int button) {
    const int before = button_;
    button_ = button;
    if (button == before)
      return Tool_event::none;
    if (button == 1)
      return counted(grab_or_create(hand));
    const Tool_event released = held_ && button == 0 ? release(hand) : Tool_event::none;
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
    const Eigen::Vector3d probe = place_of(probe_);
    const Vertex_index nearest = internal::nearest_vertex(*sculptor_, is_probe_placed_ ? probe : hand, reach_);
    if (nearest.is_valid()) {
      mesh_edits_.begin_stroke();
      hold(nearest, internal::vertex_normal(sculptor_->mesh(), nearest));
      return Tool_event::grabbed;
    }
    if (!touched_)
      return Tool_event::refused;
    const auto face = *touched_;
    const Eigen::Vector3d away = last_push_;
    park_probe(away); // or it would stand where the new vertex is to be
    const Journal_entry wanted = internal::creation_at(*sculptor_, face, probe);
    if (const auto made = mesh_edits_.make_in_stroke(wanted)) {
      hold(*made.vertex, away);
      return wanted.kind == Journal_entry::Kind::insert_on_edge ? Tool_event::created_on_edge
                                                                : Tool_event::created_on_face;
    }
    is_probe_placed_ = internal::put_probe(*sculptor_, probe_, probe);
    touched_ = face;
    return Tool_event::refused;
  }

  /// From the next move() on.
  void hold(Vertex_index v, const Eigen::Vector3d& away) {
    park_probe(away);
    grab_.emplace(sculptor_->grab(v));
    held_ = true, is_anchored_ = false;
  }

  /// Out of the way of what will be dragged.
  void park_probe(const Eigen::Vector3d& away) {
    grab_.reset();
    touched_.reset();
    if (is_probe_placed_)
      internal::put_probe(*sculptor_, probe_, internal::in_range(place_of(probe_) + 4 * map_.scale() * away));
    is_probe_placed_ = false;
  }

  Tool_event release(const Eigen::Vector3d& hand) {
    const Vertex_index v = grab_->vertex();
    const Eigen::Vector3d place = place_of(v), away = internal::vertex_normal(sculptor_->mesh(), v);
    grab_.reset();
    held_ = false;
    mesh_edits_.end_stroke();
    put_probe_near(place, away, hand);
    return Tool_event::released;
  }

  /// Outside, a little off the surface; from a pit too thin for that, out through what is around it.
  void put_probe_near(const Eigen::Vector3d& place, const Eigen::Vector3d& away, const Eigen::Vector3d& hand) {
    is_probe_placed_ = false;
    for (const double share : {0.02, 0.2, 1.0})
      is_probe_placed_ = is_probe_placed_ || internal::put_probe(*sculptor_, probe_, place + share * reach_ * away);
    for (const Eigen::Vector3d& direction : {away, last_push_})
      is_probe_placed_ = is_probe_placed_ || internal::put_probe_beyond(*sculptor_, probe_, place, direction,
                                                                        4 * map_.scale(), 0.2 * reach_);
    if (is_probe_placed_)
      anchor(probe_, hand);
  }

  Tool_event remove(const Eigen::Vector3d& hand) {
    const Eigen::Vector3d from = is_probe_placed_ ? place_of(probe_) : hand;
    const Vertex_index v = held_ ? grab_->vertex() : internal::nearest_vertex(*sculptor_, from, reach_);
    if (!v.is_valid())
      return Tool_event::refused;
    const Eigen::Vector3d place = place_of(v), away = internal::vertex_normal(sculptor_->mesh(), v);
    const bool was_held = held_;
    grab_.reset();
    held_ = false;
    Journal_entry wanted;
    wanted.kind = Journal_entry::Kind::remove;
    wanted.vertices = {sculptor_->name(v), 0, 0};
    const auto made = mesh_edits_.make(wanted);
    mesh_edits_.end_stroke();
    if (was_held)
      put_probe_near(place, away, hand);
    return made ? Tool_event::removed : Tool_event::refused;
  }
};

} // namespace haptic_sculpt

#endif
