// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_TEST_EXCHANGE_WINDOW_H
#define HAPTIC_SCULPT_TEST_EXCHANGE_WINDOW_H

#include "haptic_rendering/exchange/Surface.h"

#include <boost/test/unit_test.hpp>

#include <random>

namespace exchange_tests {

using Command = Loop_command<Scene>;

/// What a window's thread does: shows, and asks for edits.
class Window {
public:
  Window(Loop_desk<Scene>& desk, Scene_feed& feed, std::uint64_t seed) : desk_(desk), feed_(feed), random_(seed) {}

  std::size_t done = 0, refused = 0, copies = 0, left = 0;
  Scene_copy* shown = nullptr; ///< of copy_
  bool is_current = false;     ///< nothing was lost since the copy

  void ask_for_copy() {
    if (asked_)
      return;
    asked_ = std::make_unique<Copy_task<Scene>>(4000, 8000);
    Command command;
    command.kind = Command::Kind::task, command.task = asked_.get();
    lost_at_copy_ = feed_.lost_changes();
    if (!desk_.ask(command))
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
    if ((edit.kind == Kind::flip || edit.kind == Kind::collapse) && shown) {
      const auto& f = shown->faces[random_() % 200];
      if (f[0] != Scene_copy::no_corner)
        edit.vertices = {shown->ids[f[0]], shown->ids[f[1]], 0};
    }
    if (edit.kind == Kind::insert_on_face && shown) { // on a face that is seen; maybe it is gone by then
      const auto& f = shown->faces[random_() % 200];
      if (f[0] == Scene_copy::no_corner)
        return;
      for (int i = 0; i < 3; ++i) {
        edit.vertices[i] = shown->ids[f[i]];
        for (int k = 0; k < 3; ++k)
          edit.point[k] += shown->points[f[i]][k] / 3;
      }
    }
    desk_.ask(command);
  }

  void look() {
    Scene_change change;
    while (feed_.take(change)) {
      if (change.kind == Scene_change::Kind::replaced)
        is_current = false;
      later_.push_back(change);
      if (shown && change.number > shown->number)
        shown->follow(change);
    }
    Tick_view tick;
    while (feed_.take(tick))
      last_tick = tick.tick;
    Loop_answer<Scene> answer;
    while (desk_.take(answer)) {
      ++(answer.done ? done : refused);
      left += answer.left != nullptr;
      if (answer.task == nullptr)
        continue;
      ++copies;
      BOOST_TEST(answer.task == asked_.get());
      copy_ = std::move(asked_);
      shown = &copy_->copy;
      BOOST_TEST(shown->is_whole());
      // What was lost before the last change in the copy does not matter; that of later ones is not known here.
      is_current = true;
      for (const Scene_change& c : later_) {
        is_current = is_current && !(c.kind == Scene_change::Kind::replaced && c.number > shown->number);
        if (c.number > shown->number)
          shown->follow(c);
      }
    }
    if (!asked_)
      later_.clear();
    if (feed_.lost_changes() != lost_at_copy_)
      is_current = false;
  }
  std::uint64_t last_tick = 0;

private:
  Loop_desk<Scene>& desk_;
  Scene_feed& feed_;
  std::mt19937_64 random_;
  std::unique_ptr<Copy_task<Scene>> asked_, copy_;
  std::vector<Scene_change> later_; ///< while a copy is on its way
  std::uint64_t lost_at_copy_ = 0;
};

} // namespace exchange_tests

#endif
