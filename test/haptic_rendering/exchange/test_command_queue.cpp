// SPDX-License-Identifier: GPL-3.0-or-later
// Tasks: what another thread has the loop's do between two ticks. All in one thread, so each tick is known.
#include "haptic_rendering/exchange/Queue_bench.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <string>

using namespace haptic_sculpt;
using namespace exchange_tests;

namespace {

// Each answer finds room: as much is asked for as has not been answered and taken.
BOOST_AUTO_TEST_CASE(a_full_queue_takes_nothing_until_an_answer_is_taken) {
  Command_queue<Scene> queue(4);
  Command command, taken;
  Loop_answer<Scene> answer;
  for (command.ticket = 0; command.ticket < 4; ++command.ticket)
    BOOST_TEST(queue.ask(command));
  BOOST_TEST(!queue.ask(command));
  for (int k = 0; k < 4; ++k) {
    BOOST_TEST(queue.take(taken));
    BOOST_TEST(!queue.ask(command)); // there is room for commands, and none for their answers
    answer.ticket = taken.ticket;
    queue.answer(answer);
  }
  BOOST_TEST(!queue.ask(command));
  for (std::uint64_t ticket = 0; ticket < 4; ++ticket) {
    BOOST_TEST(queue.waiting() == 4u);
    BOOST_TEST((queue.take(answer) && answer.ticket == ticket));
    BOOST_TEST(queue.ask(command));
    BOOST_TEST(!queue.ask(command));
  }
}

BOOST_AUTO_TEST_CASE(tasks_go_on_once_a_tick_beside_what_is_asked_for_later) {
  Queue d;
  Counting at_once(1), three(3), two(2);
  d.ask(Command::Kind::task, 1, &three);
  d.ask(Command::Kind::task, 2, &at_once);
  d.ask(Command::Kind::task, 3, &two);
  d.ask(Command::Kind::let_go, 4);
  d.tick();
  BOOST_TEST(three.calls == 1);
  BOOST_TEST(d.answers().empty());
  d.tick();
  BOOST_TEST((d.answers() == Tickets{2}));
  BOOST_TEST(d.last.task == &at_once);
  BOOST_TEST(d.last.tick == 1u);
  d.tick();
  BOOST_TEST((d.answers() == Tickets{1}));
  BOOST_TEST(two.calls == 1);
  d.tick();
  BOOST_TEST((d.answers() == Tickets{3, 4}));
  BOOST_TEST(d.queue.waiting() == 0u);
  d.tick();
  BOOST_TEST((three.calls == 3 && two.calls == 2 && at_once.calls == 1));
}

BOOST_AUTO_TEST_CASE(copies_are_made_one_after_the_other) {
  Queue d;
  Copy_task<Scene> first(4000, 8000), second(4000, 8000), small(10, 8000);
  d.ask(Command::Kind::task, 1, &first);
  d.ask(Command::Kind::task, 2, &second);
  d.ask(Command::Kind::task, 3, &small);
  for (int k = 0; k < 20; ++k)
    d.tick();
  BOOST_TEST((d.answers() == Tickets{1, 2, 3}));
  BOOST_TEST((first.copy.is_whole() && second.copy.is_whole() && !small.copy.is_whole()));
  BOOST_TEST((surface_of(second.copy) == surface_of(*d.scene)));
}

BOOST_AUTO_TEST_CASE(a_command_that_lacks_what_it_is_about_is_answered) {
  Queue d;
  Command enter;
  enter.kind = Command::Kind::enter;
  BOOST_TEST(d.queue.ask(enter));
  d.ask(Command::Kind::task, 1);
  for (int k = 0; k < 3; ++k)
    d.tick();
  BOOST_TEST((d.answers() == Tickets{0, 1}));
  BOOST_TEST((!d.last.done && d.last.failure[0] != 0));
}

BOOST_AUTO_TEST_CASE(clutch_and_zoom_are_asked_for_by_another_thread) {
  Queue d;
  d.tick();
  Command command;
  command.kind = Command::Kind::clutch, command.opens = true;
  BOOST_TEST(d.queue.ask(command));
  d.tick();
  BOOST_TEST(d.loop.is_clutch_open());
  for (const double factor : {2.0, 0.0}) {
    command.kind = Command::Kind::zoom, command.factor = factor;
    BOOST_TEST(d.queue.ask(command));
    d.tick();
    BOOST_TEST(d.answers().size() > 0u);
    BOOST_TEST(d.last.done == (factor > 0));
    BOOST_TEST((d.last.failure[0] != 0) == (factor == 0)); // no scale
  }
  command.kind = Command::Kind::clutch, command.opens = false;
  BOOST_TEST(d.queue.ask(command));
  d.tick();
  BOOST_TEST(!d.loop.is_clutch_open());
  BOOST_TEST(std::abs(d.loop.map().scale() - 2 * map_of_tests.scale()) <= 1e-12 * map_of_tests.scale());
}

BOOST_AUTO_TEST_CASE(what_throws_is_answered_with_its_reason_and_the_queue_and_the_force_go_on) {
  Queue d;
  struct Throwing : Counting {
    using Counting::Counting;
    bool go_on(Scene& scene, Tool_type& tool) override {
      if (Counting::go_on(scene, tool))
        throw Error("that will not do");
      return false;
    }
  } at_once(1), later(3);
  struct Odd : Counting {
    using Counting::Counting;
    bool go_on(Scene&, Tool_type&) override { throw 7; }
  } odd(1);
  Counting last(2);
  d.ask(Command::Kind::task, 1, &at_once);
  d.ask(Command::Kind::task, 2, &later);
  d.ask(Command::Kind::task, 3, &odd);
  for (int k = 0; k < 4; ++k)
    d.tick();
  BOOST_TEST((d.answers() == Tickets{1, 3, 2}));
  BOOST_TEST(!d.last.done);
  BOOST_TEST(std::string(d.last.failure.data()) == "that will not do");
  BOOST_TEST(d.last.task == &later);
  const auto face = *d.scene->mesh.faces().begin();
  const auto probe_before = d.loop.tool().probe()->position();
  for (const double x : {std::nan(""), 1e305, -std::numeric_limits<double>::infinity()})
    for (const auto kind : {Edit_kind::insert_on_face, Edit_kind::insert_on_edge}) {
      Command command;
      command.kind = Command::Kind::edit, command.ticket = 5, command.edit = Edit::of(kind, {}, {x, 0, 0});
      int i = 0;
      for (const auto v : d.scene->mesh.vertices_around_face(d.scene->mesh.halfedge(face)))
        command.edit.vertices[static_cast<std::size_t>(i++)] = d.scene->sculptor.id(v);
      BOOST_TEST(d.queue.ask(command));
      const Haptic_tick& made = d.session.tick(reading_at(0));
      BOOST_TEST((d.answers() == Tickets{5}));
      BOOST_TEST(!d.last.done);
      BOOST_TEST((made.fault == Loop_fault::none));
      BOOST_TEST(d.loop.tool().holds_probe());
    }
  BOOST_TEST((d.loop.tool().probe()->position() == probe_before)); // where it was before each of them
  d.ask(Command::Kind::task, 6, &last);
  d.tick(), d.tick();
  BOOST_TEST((d.answers() == Tickets{6}));
  BOOST_TEST(d.last.done);
  BOOST_TEST(d.last.failure[0] == '\0');
}

} // namespace
