// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_EXCHANGE_LOOP_SESSION_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_EXCHANGE_LOOP_SESSION_H

#include <haptic_sculpt/haptic_rendering/exchange/Edit_journal.h>
#include <haptic_sculpt/haptic_rendering/exchange/Loop_scene.h>

namespace haptic_sculpt {

/// What another thread asks of the loop's.
template <class Scene>
struct Loop_command {
  /// What is asked for.
  enum class Kind : std::uint8_t {
    let_go, ///< what the hand holds, until the button is pressed again
    undo,   ///< a grab, from the button's press to its release, is one step
    redo,
    insert_on_face, ///< a vertex at `point` on the face of three `vertices`
    insert_on_edge, ///< a vertex at `point` on the edge of the first two
    remove,         ///< the first of `vertices`
    copy,           ///< the mesh into `copy`, to save or to show it; takes some ticks
    enter,          ///< `scene` in place of the one sculpted so far, which comes back; not where a journal is kept
    restart         ///< after a fault
  };
  Kind kind = Kind::let_go;                ///< says which of the members below count
  std::uint64_t ticket = 0;                ///< comes back with the answer
  std::array<std::uint64_t, 3> vertices{}; ///< `Sculptor::name()`s
  std::array<double, 3> point{};           ///< in the scene
  Scene_copy* copy = nullptr;              ///< the asking thread's; not to be touched until the answer
  Scene* scene = nullptr;                  ///< from here on the loop's
};

/// What came of it.
template <class Scene>
struct Loop_answer {
  typename Loop_command<Scene>::Kind kind{}; ///< of the command
  std::uint64_t ticket = 0,                  ///< of the command
      tick = 0;                              ///< the first tick after it
  bool done = false;                         ///< false: refused, or a copy that had too little room
  Refusal_reason reason{};                   ///< where an edit was refused
  std::uint64_t vertex = 0;                  ///< of an edit: the vertex that it says, `Sculptor::name()`
  Scene_copy* copy = nullptr;                ///< that of a command to copy: the asking thread's again
  Scene* left = nullptr;                     ///< the asking thread's again, to be destroyed there
};

/// Between one thread that asks and the loop's: a queue of commands and one of answers. Bounded, without locks.
template <class Scene>
class Loop_desk {
public:
  /// \param room for so many commands whose answers have not been taken
  explicit Loop_desk(std::size_t room = 256) : commands_(room), answers_(2 * room), room_(room) {}

  /// \name The asking thread
  ///@{

  /// Asks for something; the answer is to be taken. \return false where the queue is full; take answers, and ask later
  bool ask(const Loop_command<Scene>& command) {
    if (asked_ - answered_ >= room_ || !commands_.push(command))
      return false;
    ++asked_;
    return true;
  }
  /// Takes the next answer, in the order of the commands. \return false where there is none yet
  bool take(Loop_answer<Scene>& answer) { return answers_.pop(answer) && ++answered_ != 0; }
  ///@}

  /// \name The loop's thread
  ///@{

  /// Takes the next command. \return false where there is none
  bool take(Loop_command<Scene>& command) { return commands_.pop(command); }
  void answer(const Loop_answer<Scene>& answer) { answers_.push(answer); } ///< there is room: see ask()
  ///@}

private:
  boost::lockfree::spsc_queue<Loop_command<Scene>> commands_;
  boost::lockfree::spsc_queue<Loop_answer<Scene>> answers_;
  std::size_t room_, asked_ = 0, answered_ = 0; ///< of the asking thread
};

/// A loop that others may talk to: takes a command before a tick, at most one, tells a viewer of each change and tick,
/// and keeps a journal. Only the thread that calls `tick()` touches the mesh; it waits for nobody.
///
/// \tparam Loop Haptic_loop or Pose_loop on the Sculptor of a Loop_scene
template <class Loop, class Scene>
class Loop_session {
public:
  using Kind = typename Loop_command<Scene>::Kind; ///< of commands
  /// Elements copied a tick, about 30 microseconds.
  static constexpr std::size_t copied_a_tick = 1000;

  /// All must outlive this; desk, feed and journal may be null.
  Loop_session(Loop& loop, Scene& scene, Loop_desk<Scene>* desk, Scene_feed* feed, Edit_journal* journal)
      : loop_(&loop), scene_(&scene), desk_(desk), feed_(feed), journal_(journal) {
    loop.tool().keep_journal(journal);
    scene.sculptor.visitor().tell_to(feed);
  }
  ~Loop_session() {
    loop_->tool().keep_journal(nullptr);
    scene_->sculptor.visitor().tell_to(static_cast<Scene_feed*>(nullptr));
    scene_->sculptor.visitor().tell_to(static_cast<Scene_copy*>(nullptr));
  }
  Loop_session(const Loop_session&) = delete;
  Loop_session& operator=(const Loop_session&) = delete;

  /// \throw what drags throw: Mesh_changed, Out_of_range
  template <class Reading>
  const auto& tick(const Reading& reading) {
    if (desk_ != nullptr)
      serve();
    const auto& made = loop_->tick(reading);
    if (journal_ != nullptr)
      journal_->end_tick(ticks_);
    if (feed_ != nullptr)
      feed_->tell(view_of(made));
    ++ticks_;
    return made;
  }

  /// Lets go, and what is done is in the journal. To be called after the last tick.
  void end() {
    loop_->tool().let_go();
    if (journal_ != nullptr)
      journal_->end_tick(ticks_++);
  }

  std::uint64_t ticks() const { return ticks_; } ///< made so far; where a journal is kept end() counts as one
  /// That is sculpted now.
  Scene& scene() { return *scene_; }

private:
  Loop* loop_;
  Scene* scene_;
  Loop_desk<Scene>* desk_;
  Scene_feed* feed_;
  Edit_journal* journal_;
  std::uint64_t ticks_ = 0;
  std::optional<Loop_command<Scene>> copying_;

  void serve() {
    Loop_command<Scene> command;
    if (copying_) {
      if (!copying_->copy->copy_some(scene_->sculptor, scene_->probe, copied_a_tick))
        return;
      scene_->sculptor.visitor().tell_to(static_cast<Scene_copy*>(nullptr));
      copying_->copy->number = feed_ != nullptr ? feed_->number() : 0;
      Loop_answer<Scene> answer = answer_to(*copying_);
      answer.done = copying_->copy->is_whole(), answer.copy = copying_->copy;
      desk_->answer(answer);
      copying_.reset();
    } else if (desk_->take(command)) {
      carry_out(command);
    }
  }

  Loop_answer<Scene> answer_to(const Loop_command<Scene>& command) const {
    Loop_answer<Scene> answer;
    answer.kind = command.kind, answer.ticket = command.ticket, answer.tick = ticks_;
    return answer;
  }

  void carry_out(const Loop_command<Scene>& command) {
    Loop_answer<Scene> answer = answer_to(command);
    answer.done = true;
    switch (command.kind) {
    case Kind::let_go:
      loop_->tool().let_go();
      break;
    case Kind::restart:
      loop_->restart();
      break;
    case Kind::copy:
      copying_ = command;
      command.copy->begin();
      scene_->sculptor.visitor().tell_to(command.copy);
      return; // answered when it is whole
    case Kind::enter:
      answer.done = journal_ == nullptr; // a log is of one mesh
      answer.left = answer.done ? enter(*command.scene) : command.scene;
      break;
    default:
      edit(command, answer);
    }
    desk_->answer(answer);
  }

  Scene* enter(Scene& scene) {
    loop_->enter(scene.sculptor, scene.probe, scene.map);
    scene_->sculptor.visitor().tell_to(static_cast<Scene_feed*>(nullptr));
    Scene* const left = std::exchange(scene_, &scene);
    scene.sculptor.visitor().tell_to(feed_);
    Scene_change change;
    change.kind = Scene_change::Kind::replaced;
    if (feed_ != nullptr)
      feed_->tell(change);
    return left;
  }

  void edit(const Loop_command<Scene>& command, Loop_answer<Scene>& answer) {
    Journal_entry entry;
    entry.kind = command.kind == Kind::undo             ? Journal_entry::Kind::undo
                 : command.kind == Kind::redo           ? Journal_entry::Kind::redo
                 : command.kind == Kind::insert_on_face ? Journal_entry::Kind::insert_on_face
                 : command.kind == Kind::insert_on_edge ? Journal_entry::Kind::insert_on_edge
                                                        : Journal_entry::Kind::remove;
    entry.vertices = command.vertices, entry.point = command.point;
    const auto made = loop_->tool().edit(entry);
    answer.done = static_cast<bool>(made);
    if (made)
      answer.vertex = made.vertex && made.vertex->is_valid() ? scene_->sculptor.name(*made.vertex) : 0;
    else
      answer.reason = made.refusal->reason;
  }

  template <class Tick>
  Tick_view view_of(const Tick& made) const {
    const auto array = [](const Eigen::Vector3d& v) { return std::array<double, 3>{v[0], v[1], v[2]}; };
    Tick_view view;
    view.tick = ticks_;
    view.target = array(made.tool.target), view.proxy = array(made.tool.proxy), view.force = array(force_of(made, 0));
    view.reached = made.tool.reached, view.contacts = made.tool.contacts;
    view.event = made.tool.event, view.fault = made.fault;
    view.holds_vertex = loop_->tool().holds_vertex();
    view.vertex = view.holds_vertex ? scene_->sculptor.name(loop_->tool().vertex()) : 0;
    return view;
  }
  template <class Tick>
  static auto force_of(const Tick& made, int) -> decltype(made.rendered.force) {
    return made.rendered.force;
  }
  template <class Tick>
  static auto force_of(const Tick& made, long) -> decltype(made.force) {
    return made.force;
  }
};

} // namespace haptic_sculpt

#endif
