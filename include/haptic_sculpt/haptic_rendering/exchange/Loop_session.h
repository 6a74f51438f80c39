// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/exchange/Copy_task.h>
#include <haptic_sculpt/haptic_rendering/exchange/Loop_scene.h>
#include <haptic_sculpt/haptic_rendering/exchange/Scene_feed.h>

#include <cstring>
#include <new>
#include <utility>

namespace haptic_sculpt {

/// A loop that others may talk to: takes a command before a tick, at most one, goes on with tasks, passes changed
/// faces and ticks on to a viewer, and keeps a journal. Only the thread that calls `tick()` touches the mesh; it waits
/// for nobody.
///
/// \tparam Loop Haptic_loop or Pose_loop on the Sculptor of a Loop_scene
template <class Loop, class Scene>
class Loop_session {
public:
  using Kind = typename Loop_command<Scene>::Kind;          ///< of commands
  using Feed = Basic_scene_feed<typename Scene::Face_type>; ///< to a viewer
  /// Tasks under way at once; while there are this many no other command is taken.
  static constexpr std::size_t most_tasks = 16;
  /// Changed faces that are passed on by a tick, about 50 microseconds.
  static constexpr std::size_t faces_a_tick = 1000;

  /// All must outlive this; queue, feed and journal may be null. A journal begins where the hand holds nothing, and
  /// says what is done from here on. What can be undone by then is not in it: where its log does not hold that either,
  /// call Sculptor::forget_history() first. \pre no entry of another session waits in the journal: ticks count from 0
  Loop_session(Loop& loop, Scene& scene, Command_queue<Scene>* queue, Feed* feed, Edit_journal* journal)
      : loop_(&loop), scene_(&scene), queue_(queue), feed_(feed), journal_(journal) {
    tasks_.reserve(most_tasks); // may throw: then no tool keeps the journal of a session that never was
    journal_number_ = loop.tool().keep_journal(journal);
  }
  /// What is under way is answered as by end().
  ~Loop_session() {
    answer_what_waits();
    loop_->tool().end_journal(journal_number_); // another session may have begun
    scene_->sculptor.visitor().mark_all(); // another session's viewer has none of them
  }
  Loop_session(const Loop_session&) = delete;
  Loop_session& operator=(const Loop_session&) = delete;

  /// What a command or task throws is its answer, what the loop throws a fault of the loop: the force is given anyway.
  /// A journal that has overrun ends the loop by Loop_fault::log, once: after a restart nothing is in it any more.
  /// Beside another fault it does so after the restart; of a scene that is left, in the one that is entered.
  template <class Reading>
  const auto& tick(const Reading& reading) noexcept {
    if (queue_ != nullptr)
      serve();
    const auto& made = loop_->tick(reading);
    if (journal_ != nullptr) {
      journal_->end_tick(ticks_);
      if (journal_->has_overrun() && !has_told_overrun_) {
        loop_->end_by(Loop_fault::log);
        has_told_overrun_ = loop_->interaction().fault() == Loop_fault::log;
      }
      has_passed_on_ = made.fault == Loop_fault::log;
    }
    if (feed_ != nullptr) {
      pass_faces_on();
      Tick_view view = view_of(made);
      loop_->attempt([&] { name_vertex(view); });
      feed_->tell(view);
    }
    ++ticks_;
    return made;
  }

  /// Passes on what has changed, as tick() does. \pre there is a feed
  void pass_faces_on() noexcept {
    loop_->attempt([this] { // a Sculptor that a fault has left unfinished answers nothing
      Changed_faces& changed = scene_->sculptor.visitor().changed;
      for (std::size_t i = 0; i < faces_a_tick && changed.size() > 0 && feed_->tell(face(changed.front())); ++i)
        changed.pop();
    });
  }

  /// Lets go, and what is done is in the journal. Tasks under way, and what waits for them, are answered: not done.
  /// What is still in the queue waits there for another session. To be called after the last tick.
  /// \throw Reentrant_call, and nothing has changed
  void end() {
    loop_->tool().let_go();
    answer_what_waits();
    if (journal_ != nullptr)
      journal_->end_tick(ticks_++);
  }

  std::uint64_t ticks() const { return ticks_; } ///< made so far; where a journal is kept end() counts as one
  /// That is sculpted now.
  Scene& scene() { return *scene_; }
  Edit_journal* journal() { return journal_; } ///< that is kept now; nullptr: none

private:
  Loop* loop_;
  Scene* scene_;
  Command_queue<Scene>* queue_;
  Feed* feed_;
  Edit_journal* journal_;
  std::uint64_t journal_number_ = 0;
  bool has_told_overrun_ = false; ///< the loop has ended by this journal's
  bool has_passed_on_ = false;    ///< and the last tick says so
  std::uint64_t ticks_ = 0;
  std::uint32_t scenes_ = 0;               ///< entered before the one that is sculpted now
  std::vector<Loop_command<Scene>> tasks_; ///< under way, in the order of the commands
  std::optional<Loop_command<Scene>> next_;

  void answer_what_waits() noexcept {
    scene_->sculptor.visitor().tell_to(nullptr); // a copy under way is its owner's again
    const auto give_back = [this](const Loop_command<Scene>& command) {
      Loop_answer<Scene> answer = answer_to(command, false);
      if (command.kind == Kind::enter)
        answer.left = command.scene;
      std::strncpy(answer.failure.data(), "the session has ended", answer.failure.size() - 1);
      queue_->answer(answer);
    };
    for (const Loop_command<Scene>& task : tasks_)
      give_back(task);
    tasks_.clear();
    if (next_)
      give_back(*next_);
    next_.reset();
  }

  /// A command is taken first, so that tasks see what the asking thread did before it asked for that.
  void serve() {
    Loop_command<Scene> command;
    if (!next_ && tasks_.size() < most_tasks && queue_->take(command))
      next_ = std::move(command);
    for (std::size_t i = 0; i < tasks_.size();) {
      Loop_answer<Scene> answer = answer_to(tasks_[i], true);
      if (attempt(answer, [&] { return tasks_[i].task->go_on(*scene_, loop_->tool()); })) {
        queue_->answer(answer);
        tasks_.erase(tasks_.begin() + static_cast<std::ptrdiff_t>(i));
      } else {
        ++i;
      }
    }
    if (!next_ || (next_->kind == Kind::enter && !tasks_.empty())) // a task is of this scene
      return;
    command = std::move(*next_);
    next_.reset();
    carry_out(command);
  }

  Loop_answer<Scene> answer_to(const Loop_command<Scene>& command, bool done) const {
    Loop_answer<Scene> answer;
    answer.kind = command.kind, answer.edit = command.edit.kind, answer.ticket = command.ticket, answer.tick = ticks_;
    answer.done = done, answer.task = command.task;
    return answer;
  }

  /// The one place where what commands throw ends. \return what the function gives; true where it throws
  template <class Function>
  static bool attempt(Loop_answer<Scene>& answer, const Function& function) noexcept {
    const auto fail = [&](const char* what) {
      answer.done = false;
      std::strncpy(answer.failure.data(), what, answer.failure.size() - 1);
      return true;
    };
    try {
      return function();
    } catch (const std::exception& error) {
      return fail(error.what());
    } catch (...) { // of a task: not of this library, and yet the queue has to go on
      return fail("something was thrown that is no std::exception");
    }
  }

  void carry_out(Loop_command<Scene>& command) {
    Loop_answer<Scene> answer = answer_to(command, true);
    if (attempt(answer, [&] { return is_done(command, answer); }))
      queue_->answer(answer);
  }

  /// \return false for a task that is to go on: answered when it is done
  bool is_done(Loop_command<Scene>& command, Loop_answer<Scene>& answer) {
    switch (command.kind) {
    case Kind::let_go:
      loop_->tool().let_go();
      break;
    case Kind::clutch:
      loop_->open_clutch(command.opens);
      break;
    case Kind::zoom:
      loop_->zoom(command.factor);
      break;
    case Kind::restart: { // of another fault: who asked has not seen this one
      const bool has_told = is_overrun_seen();
      loop_->restart();
      has_told_overrun_ = has_told;
      break;
    }
    case Kind::task:
      if (command.task == nullptr)
        throw Error("the command is of the kind `task`, and has none");
      if (!command.task->go_on(*scene_, loop_->tool())) {
        tasks_.push_back(std::move(command)); // a copy could lack memory, after the task has begun
        return false;
      }
      break;
    case Kind::enter:
      if (command.scene == nullptr)
        throw Error("the command is of the kind `enter`, and has no scene");
      if (command.scene == scene_) // not `left`: it stays the loop's
        throw Error("this scene is the one that is sculpted; enter another one");
      answer.left = command.scene; // where it is refused or throws
      answer.done = journal_ == nullptr || command.journal != nullptr;
      if (answer.done)
        answer.left = enter(*command.scene, command.journal);
      break;
    case Kind::edit:
      edit(command, answer);
    }
    return true;
  }

  /// Whether a tick has said that the journal has overrun.
  bool is_overrun_seen() const {
    return has_told_overrun_ && (has_passed_on_ || loop_->interaction().fault() != Loop_fault::log);
  }

  Scene* enter(Scene& scene, Edit_journal* journal) {
    loop_->tool().let_go(); // the end of what is in hand is in the old journal
    if (journal_ != nullptr)
      journal_->end_tick(ticks_);
    const bool has_lost = journal_ != nullptr && journal_->has_overrun() && !is_overrun_seen();
    loop_->enter(scene.sculptor, scene.map);
    if (has_lost)
      loop_->end_by(Loop_fault::log); // found just now, or beside a fault that entering ends
    journal_number_ = loop_->tool().keep_journal(journal_ = journal);
    has_told_overrun_ = false;
    scene_->sculptor.visitor().mark_all(); // where it is entered again no viewer has it
    ++scenes_;
    return std::exchange(scene_, &scene);
  }

  void edit(const Loop_command<Scene>& command, Loop_answer<Scene>& answer) {
    const auto made = loop_->tool().edit(command.edit);
    answer.done = static_cast<bool>(made);
    if (made)
      answer.vertex = made.vertex && made.vertex->is_valid() ? scene_->sculptor.id(*made.vertex) : 0;
    else
      answer.reason = made.refusal->reason;
  }

  auto face(std::uint32_t index) const {
    auto face = scene_->face(index);
    face.scene = scenes_;
    return face;
  }

  template <class Tick>
  Tick_view view_of(const Tick& made) const {
    const auto array = [](const Eigen::Vector3d& v) { return std::array<double, 3>{v[0], v[1], v[2]}; };
    Tick_view view;
    view.tick = ticks_;
    view.target = array(made.tool.target), view.proxy = array(made.tool.proxy), view.force = array(made.rendered.force);
    view.reached = made.tool.reached, view.starved = made.tool.starved, view.contacts = made.tool.contacts;
    view.event = made.tool.event, view.fault = made.fault;
    view.faces_passed_on = feed_->passed_on(), view.faces_waiting = scene_->sculptor.visitor().changed.size();
    return view;
  }

  /// That is in the hand.
  void name_vertex(Tick_view& view) const {
    if (!loop_->tool().holds_vertex())
      return;
    view.vertex = scene_->sculptor.id(loop_->tool().vertex());
    view.holds_vertex = true;
  }
};

} // namespace haptic_sculpt
