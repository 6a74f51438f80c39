// SPDX-License-Identifier: GPL-3.0-or-later
// A loop, a window that asks and shows, and a writer of a journal, each with a thread. To be run with ThreadSanitizer,
// too.
#include "haptic_rendering/exchange/Threads.h"
#include "haptic_rendering/exchange/Window.h"
#include "haptic_rendering/exchange/made_again.h"

#include <haptic_sculpt/surface.h>

#include <boost/test/unit_test.hpp>

#include <chrono>
#include <thread>

using namespace haptic_sculpt;
using namespace exchange_tests;

namespace {

BOOST_AUTO_TEST_CASE(a_window_asks_and_sees_and_a_journal_is_kept_while_the_loop_runs) {
  Threads threads(std::size_t{1} << 18);
  Window window(threads.queue, threads.feed, 7);
  threads.run(true, [&] {
    for (int k = 0; k < 300 || window.last_tick < 9000; ++k) {
      window.look();
      if (window.last_tick > 1000 && k % 5 == 0)
        window.ask_for_something();
      if (k == 200)
        window.ask_for_copy();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    while (window.waits_for_copy())
      window.look();
  });
  window.look_for_the_last_time();
  BOOST_TEST_MESSAGE(threads.ticks << " ticks, " << threads.edits << " grabs and creations, " << window.done
                                   << " commands done, " << window.refused << " refused, " << threads.entries.size()
                                   << " entries");
  BOOST_TEST(window.done > 20u);
  BOOST_TEST(window.refused > 0u);
  BOOST_TEST(threads.edits >= 2u);
  BOOST_TEST(!threads.journal.has_overrun());
  BOOST_TEST(window.whole_ticks > 0u);
  BOOST_TEST((surface_of(window.shown) == surface_of(*threads.scene)));
  BOOST_TEST((made_again(meshes::to_mesh(meshes::bumpy_sphere(2, 0.12)), threads.entries) ==
              surface_of(*threads.scene)));
  BOOST_TEST(validate(threads.scene->mesh).is_valid());
  BOOST_TEST(validate(window.copy->copy.mesh<Mesh>()).is_valid()); // the mesh of one tick, though the hand went on
}

BOOST_AUTO_TEST_CASE(a_viewer_with_little_room_that_sleeps_has_all_in_the_end_and_another_scene_comes_in) {
  Threads threads(8);
  Window window(threads.queue, threads.feed, 11);
  Scene* const first = threads.scene.get();
  threads.run(false, [&] {
    while (threads.feed.lost_ticks() == 0) // nobody looks
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    Command enter;
    enter.kind = Command::Kind::enter, enter.scene = threads.other.get();
    BOOST_TEST(threads.queue.ask(enter));
    while (window.left == 0)
      window.look();
    window.ask_for_copy();
    while (window.waits_for_copy() || window.scene == 0)
      window.look();
  });
  BOOST_TEST(threads.last == threads.other.get());
  BOOST_TEST(threads.last != first);
  BOOST_TEST(window.copies == 1u);
  BOOST_TEST(validate(window.copy->copy.mesh<Mesh>()).is_valid());
  // With the loop at rest what is left comes through, and a copy is the mesh.
  window.look_for_the_last_time();
  const Scene& scene = *threads.last;
  auto& changed = threads.last->sculptor.visitor().changed;
  for (; changed.size() > 0; changed.pop())
    if (const Face_change face = scene.face(changed.front()); face.is_there)
      window.shown[face.index] = face;
    else
      window.shown.erase(face.index);
  BOOST_TEST((surface_of(window.shown) == surface_of(scene)));
  Scene_copy copy(4000, 8000);
  copy.begin();
  while (!copy.copy_some(scene.sculptor, 7))
    ;
  BOOST_TEST((surface_of(copy) == surface_of(scene)));
}

} // namespace
