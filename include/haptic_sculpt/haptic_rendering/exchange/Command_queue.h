// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Tool.h>
#include <haptic_sculpt/haptic_rendering/exchange/Edit_journal.h>

namespace haptic_sculpt {

/// Work of another thread that the loop's does between two ticks: to look at the mesh, to make several edits as one, or
/// to do a slice of something a tick. Made and destroyed by the asking thread, which leaves it alone from the command
/// to the answer, and finds in it then what came of it.
template <class Scene>
class Loop_task {
public:
  using Tool_type = Tool<typename Scene::Sculptor_type>; ///< what the hand does in the scene

  virtual ~Loop_task() = default;
  /// Called before each tick, until it says that it is done. The mesh is changed through the tool only, so that strokes
  /// and journal stay right; a setting of the Sculptor may be changed while nothing is held. Where it throws it is
  /// not called again: the answer says what was thrown. \return whether it is done
  virtual bool go_on(Scene& scene, Tool_type& tool) = 0;
};

/// What another thread asks of the loop's.
template <class Scene>
struct Loop_command {
  /// What is asked for.
  enum class Kind : std::uint8_t {
    let_go, ///< what the hand holds, until the button is pressed again
    edit,   ///< `edit`, no stroke and no end; to undo, a grab from the button's press to its release is one step
    task,   ///< `task`; what is asked for later is done beside it
    enter,  ///< another `scene` than the one sculpted so far, which comes back, once no task is under way; what is
            ///< asked for later waits behind it
    clutch, ///< opened or closed, as `opens` says
    zoom,   ///< by `factor`, once the clutch is closed
    restart ///< after a fault
  };
  Kind kind = Kind::let_go;         ///< says which of the members below count
  std::uint64_t ticket = 0;         ///< comes back with the answer
  Edit edit;                        ///< vertices by number, points in the scene
  Loop_task<Scene>* task = nullptr; ///< the asking thread's; not to be touched until the answer
  Scene* scene = nullptr;           ///< from here on the loop's
  bool opens = false;               ///< the clutch: the handle moves alone
  double factor = 1;                ///< units of the scene a metre, times this
  Edit_journal* journal = nullptr; ///< of `scene`: a log is of one mesh. None is refused where one is kept so far
};

/// What came of it.
template <class Scene>
struct Loop_answer {
  typename Loop_command<Scene>::Kind kind{}; ///< of the command
  Edit_kind edit{};                          ///< of the command's edit
  std::uint64_t ticket = 0,                  ///< of the command
      tick = 0;                              ///< the first tick after it
  bool done = false;                         ///< false: refused
  Refusal_reason reason{};                   ///< where an edit was refused
  /// Where something was thrown, what it says, cut at some hundred letters; empty else.
  std::array<char, 192> failure{};
  std::uint64_t vertex = 0;                  ///< of an edit: the vertex that it says, `Sculptor::id()`
  Loop_task<Scene>* task = nullptr;          ///< the asking thread's again
  Scene* left = nullptr;                     ///< the asking thread's again, to be destroyed there
};

/// Between one thread that asks and the loop's: a queue of commands and one of answers. Bounded, without locks.
template <class Scene>
class Command_queue {
public:
  /// \param room for this many commands whose answers have not been taken
  explicit Command_queue(std::size_t room = 256) : commands_(room), answers_(2 * room), room_(room) {}

  /// \name The asking thread
  ///@{

  /// Asks for something; the answer is to be taken. \return false where the queue is full; take answers, and ask later
  bool ask(const Loop_command<Scene>& command) {
    if (asked_ - answered_ >= room_ || !commands_.push(command))
      return false;
    ++asked_;
    return true;
  }
  /// Takes the next answer: in the order of the commands, but for tasks that take several ticks.
  /// \return false where there is none yet
  bool take(Loop_answer<Scene>& answer) { return answers_.pop(answer) && ++answered_ != 0; }
  /// Commands whose answers have not been taken.
  std::size_t waiting() const { return asked_ - answered_; }
  ///@}

  /// \name The loop's thread
  ///@{

  /// Takes the next command. \return false where there is none
  bool take(Loop_command<Scene>& command) {
    if (commands_.read_available() == 0)
      return false;
    command = std::move(commands_.front()); // pop() would copy, which may lack memory
    return commands_.pop();
  }
  void answer(const Loop_answer<Scene>& answer) { answers_.push(answer); } ///< there is room: see ask()
  ///@}

private:
  boost::lockfree::spsc_queue<Loop_command<Scene>> commands_;
  boost::lockfree::spsc_queue<Loop_answer<Scene>> answers_;
  std::size_t room_, asked_ = 0, answered_ = 0; ///< of the asking thread
};

} // namespace haptic_sculpt
