// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_rendering/exchange/Threads.h"
#include "haptic_rendering/exchange/made_again.h"

#include <memory>
#include <vector>

namespace exchange_tests {

using Command = Loop_command<Scene>;

/// Is done after this many calls.
struct Counting : Loop_task<Scene> {
  int calls = 0, most;
  Scene* seen = nullptr;
  explicit Counting(int most) : most(most) {}
  bool go_on(Scene& scene, Tool_type&) override {
    seen = &scene;
    return ++calls >= most;
  }
};

/// A loop and its queue, all in one thread, so that each tick is known.
struct Queue {
  std::unique_ptr<Scene> scene = scene_of(2), other = scene_of(1);
  Command_queue<Scene> queue{64};
  Edit_journal journal{1000}, journal_of_other{1000};
  Loop loop{scene->sculptor, scene->map, parameters_of_tests()};
  Session session;
  explicit Queue(bool keeps_journal = false)
      : session(loop, *scene, &queue, nullptr, keeps_journal ? &journal : nullptr) {}

  void ask(Command::Kind kind, std::uint64_t ticket, Loop_task<Scene>* task = nullptr) {
    Command command;
    command.kind = kind, command.ticket = ticket, command.task = task;
    if (kind == Command::Kind::enter)
      command.scene = other.get();
    BOOST_TEST(queue.ask(command));
  }
  void tick() { session.tick(reading_at(session.ticks())); }
  /// The tickets of what is answered by now.
  std::vector<std::uint64_t> answers() {
    std::vector<std::uint64_t> tickets;
    for (Loop_answer<Scene> answer; queue.take(answer); tickets.push_back(answer.ticket))
      last = answer;
    return tickets;
  }
  Loop_answer<Scene> last;
};

using Tickets = std::vector<std::uint64_t>;

} // namespace exchange_tests
