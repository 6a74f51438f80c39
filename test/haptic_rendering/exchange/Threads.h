// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_rendering/exchange/Surface.h"

#include <atomic>
#include <thread>

namespace exchange_tests {

using Loop = Pose_loop<Scene::Sculptor_type>;
using Session = Loop_session<Loop, Scene>;
using Entries = std::vector<Edit>;

/// A loop, a window and a writer, each with a thread.
struct Threads {
  std::unique_ptr<Scene> scene = scene_of(2), other = scene_of(2);
  Command_queue<Scene> queue{16};
  Scene_feed feed;
  Edit_journal journal{1000000, 1};
  Entries entries;
  std::uint64_t ticks = 0;
  std::size_t edits = 0;
  Scene* last = nullptr;

  explicit Threads(std::size_t room) : feed(room, 64) {}

  template <class Work>
  void run(bool keeps_journal, const Work& window) {
    std::atomic<bool> ends{false}, has_ended{false};
    std::thread loop_thread([&] {
      Loop loop(scene->sculptor, scene->map, parameters_of_tests());
      Session session(loop, *scene, &queue, &feed, keeps_journal ? &journal : nullptr);
      while (!ends) {
        session.tick(reading_at(session.ticks()));
        if (loop.has_stopped())
          break;
        if (session.ticks() % 8 == 0) // others get a turn
          std::this_thread::yield();
      }
      session.end();
      ticks = session.ticks(), edits = loop.tool().edits().grabbed + loop.tool().edits().created;
      last = &session.scene();
      has_ended = true;
    });
    std::thread writer([&] {
      Edit entry;
      for (bool was_ended = false; keeps_journal;) {
        while (journal.take(entry)) {
          entries.push_back(entry);
          journal.wrote(entry.kind == Edit_kind::none);
        }
        if (was_ended)
          break;
        was_ended = has_ended;
        std::this_thread::yield();
      }
    });
    window();
    ends = true;
    loop_thread.join(), writer.join();
  }
};

} // namespace exchange_tests
