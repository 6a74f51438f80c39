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
  Window window(threads.desk, threads.feed, 7);
  threads.run(true, [&] {
    window.ask_for_copy();
    for (int k = 0; k < 300 || window.last_tick < 9000; ++k) {
      window.look();
      if (!window.waits_for_copy() && window.last_tick > 1000 && k % 5 == 0)
        window.ask_for_something();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    while (window.waits_for_copy())
      window.look();
  });
  window.look();
  BOOST_TEST_MESSAGE(threads.ticks << " ticks, " << threads.edits << " grabs and creations, " << window.done
                                   << " commands done, " << window.refused << " refused, " << threads.entries.size()
                                   << " entries");
  BOOST_TEST(window.done > 20u);
  BOOST_TEST(window.refused > 0u);
  BOOST_TEST(threads.edits >= 2u);
  BOOST_TEST(threads.feed.lost_changes() == 0u);
  BOOST_TEST(!threads.journal.has_overrun());
  BOOST_TEST(window.is_current);
  BOOST_TEST((surface_of(*window.shown) == surface_of(*threads.scene)));
  BOOST_TEST((made_again(meshes::to_mesh(meshes::bumpy_sphere(2, 0.12)), threads.entries) ==
              surface_of(*threads.scene)));
  BOOST_TEST(validate(threads.scene->mesh).is_valid());
  BOOST_TEST(validate(window.shown->mesh<Mesh>()).is_valid());
}

BOOST_AUTO_TEST_CASE(a_slow_viewer_loses_changes_is_told_and_gets_a_copy_and_another_scene_comes_in) {
  Threads threads(8);
  Window window(threads.desk, threads.feed, 11);
  Scene* const first = threads.scene.get();
  threads.run(false, [&] {
    while (threads.feed.lost_changes() == 0) // nobody looks
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    Command enter;
    enter.kind = Command::Kind::enter, enter.scene = threads.other.get();
    BOOST_TEST(threads.desk.ask(enter));
    while (window.left == 0)
      window.look();
    BOOST_TEST(!window.is_current);
    window.ask_for_copy();
    while (window.waits_for_copy())
      window.look();
  });
  const std::uint64_t lost = threads.feed.lost_changes();
  BOOST_TEST(lost > 0u);
  BOOST_TEST(threads.feed.lost_ticks() > 0u);
  BOOST_TEST(threads.last == threads.other.get());
  BOOST_TEST(threads.last != first);
  BOOST_TEST(window.copies == 1u);
  BOOST_TEST(validate(window.shown->mesh<Mesh>()).is_valid()); // the mesh of one tick, though the hand went on
  // With the loop at rest a copy is the mesh, whatever was lost.
  Scene_copy copy(4000, 8000);
  copy.begin();
  while (!copy.copy_some(threads.last->sculptor, 7))
    ;
  BOOST_TEST((surface_of(copy) == surface_of(*threads.last)));
}

} // namespace
