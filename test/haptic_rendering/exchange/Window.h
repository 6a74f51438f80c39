// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_rendering/exchange/Surface.h"

#include <boost/test/unit_test.hpp>

#include <random>

namespace exchange_tests {

using Command = Loop_command<Scene>;

/// What a window's thread does: shows, and asks for edits.
class Window {
public:
  Window(Command_queue<Scene>& queue, Scene_feed& feed, std::uint64_t seed)
      : queue_(queue), feed_(feed), random_(seed) {}

  std::size_t done = 0, refused = 0, copies = 0, left = 0, whole_ticks = 0;
  std::uint32_t scene = 0;
  std::map<std::uint32_t, Face_change> shown; ///< by index, the faces that are there
  bool is_whole = false;                      ///< as of the last tick
  std::unique_ptr<Copy_task<Scene>> copy;     ///< the last that came

  void ask_for_copy() {
    if (asked_)
      return;
    asked_ = std::make_unique<Copy_task<Scene>>(4000, 8000);
    Command command;
    command.kind = Command::Kind::task, command.task = asked_.get();
    if (!queue_.ask(command))
      asked_.reset();
  }
  bool waits_for_copy() const { return asked_ != nullptr; }

  void ask_for_something() {
    Command command;
    const auto vertex = random_() % 160;
    using Kind = Edit_kind;
    constexpr Kind kinds[] = {Kind::undo, Kind::redo, Kind::remove, Kind::insert_on_face,
                              Kind::none, Kind::undo, Kind::flip,   Kind::collapse};
    Edit& edit = command.edit;
    edit = Edit::of(kinds[random_() % 8], {vertex, vertex + 1, vertex + 2});
    if (edit.kind != Kind::none) // lets go
      command.kind = Command::Kind::edit;
    const auto seen = shown.find(static_cast<std::uint32_t>(random_() % 200)); // maybe it is gone by then
    if ((edit.kind == Kind::flip || edit.kind == Kind::collapse) && seen != shown.end())
      edit.vertices = {seen->second.vertices[0], seen->second.vertices[1], 0};
    if (edit.kind == Kind::insert_on_face) {
      if (seen == shown.end())
        return;
      for (std::size_t i = 0; i < 3; ++i) {
        edit.vertices[i] = seen->second.vertices[i];
        for (std::size_t k = 0; k < 3; ++k)
          edit.point[k] += seen->second.corners[i][k] / 3;
      }
    }
    queue_.ask(command);
  }

  void look() {
    Tick_view tick;
    while (feed_.take(tick)) {
      last_tick = tick.tick;
      take_faces(tick.faces_passed_on);
      is_whole = tick.faces_waiting == 0 && taken_ == tick.faces_passed_on;
      whole_ticks += is_whole;
    }
    Loop_answer<Scene> answer;
    while (queue_.take(answer)) {
      ++(answer.done ? done : refused);
      left += answer.left != nullptr;
      if (answer.task == nullptr)
        continue;
      ++copies;
      BOOST_TEST(answer.task == asked_.get());
      copy = std::move(asked_);
      BOOST_TEST(copy->copy.is_whole());
    }
  }
  /// What was passed on since the last tick, too.
  void look_for_the_last_time() {
    look();
    take_faces(std::numeric_limits<std::uint64_t>::max());
  }
  std::uint64_t last_tick = 0;

private:
  Command_queue<Scene>& queue_;
  Scene_feed& feed_;
  std::mt19937_64 random_;
  std::unique_ptr<Copy_task<Scene>> asked_;
  std::uint64_t taken_ = 0; ///< faces

  void take_faces(std::uint64_t until) {
    for (Face_change face; taken_ < until && feed_.take(face); ++taken_)
      show(face, shown, scene);
  }
};

} // namespace exchange_tests
