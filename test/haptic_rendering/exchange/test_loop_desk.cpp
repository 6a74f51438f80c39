// SPDX-License-Identifier: GPL-3.0-or-later
// Tasks: what another thread has the loop's do between two ticks. All in one thread, so each tick is known.
#include "haptic_rendering/exchange/Threads.h"

#include <boost/test/unit_test.hpp>

using namespace haptic_sculpt;
using namespace exchange_tests;

namespace {

using Command = Loop_command<Scene>;

/// Is done after so many calls.
struct Counting : Loop_task<Scene> {
  int calls = 0, most;
  Scene* seen = nullptr;
  explicit Counting(int most) : most(most) {}
  bool go_on(Scene& scene, Tool_type&) override {
    seen = &scene;
    return ++calls >= most;
  }
};

struct Desk {
  std::unique_ptr<Scene> scene = scene_of(2), other = scene_of(1);
  Loop_desk<Scene> desk{64};
  Edit_journal journal{1000}, journal_of_other{1000};
  Loop loop{scene->sculptor, scene->probe, scene->map, parameters_of_tests()};
  Session session;
  explicit Desk(bool keeps_journal = false)
      : session(loop, *scene, &desk, nullptr, keeps_journal ? &journal : nullptr) {}

  void ask(Command::Kind kind, std::uint64_t ticket, Loop_task<Scene>* task = nullptr) {
    Command command;
    command.kind = kind, command.ticket = ticket, command.task = task;
    if (kind == Command::Kind::enter)
      command.scene = other.get();
    BOOST_TEST(desk.ask(command));
  }
  void tick() { session.tick(reading_at(session.ticks())); }
  /// The tickets of what is answered by now.
  std::vector<std::uint64_t> answers() {
    std::vector<std::uint64_t> tickets;
    for (Loop_answer<Scene> answer; desk.take(answer); tickets.push_back(answer.ticket))
      last = answer;
    return tickets;
  }
  Loop_answer<Scene> last;
};

using Tickets = std::vector<std::uint64_t>;

BOOST_AUTO_TEST_CASE(tasks_go_on_once_a_tick_beside_what_is_asked_for_later) {
  Desk d;
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
  BOOST_TEST(d.desk.waiting() == 0u);
  d.tick();
  BOOST_TEST((three.calls == 3 && two.calls == 2 && at_once.calls == 1));
}

BOOST_AUTO_TEST_CASE(another_scene_is_entered_once_no_task_is_under_way_and_with_a_journal_of_its_own) {
  Desk d(true);
  Counting three(3), later(1);
  d.ask(Command::Kind::task, 1, &three);
  d.ask(Command::Kind::enter, 2); // without a journal: refused
  for (int k = 0; k < 4; ++k)
    d.tick();
  BOOST_TEST((d.answers() == Tickets{1, 2}));
  BOOST_TEST(!d.last.done);
  BOOST_TEST(d.last.left == d.other.get());
  while (!d.loop.tool().holds_vertex())
    d.tick();
  Counting two(2);
  d.ask(Command::Kind::task, 3, &two);
  Command enter;
  enter.kind = Command::Kind::enter, enter.ticket = 4, enter.scene = d.other.get(), enter.journal = &d.journal_of_other;
  BOOST_TEST(d.desk.ask(enter));
  d.ask(Command::Kind::task, 5, &later);
  for (int k = 0; k < 4; ++k)
    d.tick();
  BOOST_TEST((d.answers() == Tickets{3, 4, 5}));
  BOOST_TEST((two.seen == d.scene.get() && later.seen == d.other.get()));
  BOOST_TEST(d.session.journal() == &d.journal_of_other);
  Journal_entry entry, last_edit;
  while (d.journal.take(entry))
    if (entry.kind != Journal_entry::Kind::tick)
      last_edit = entry;
  BOOST_TEST((last_edit.kind == Journal_entry::Kind::end)); // what was held in the old scene, ends there
  BOOST_TEST((entry.kind == Journal_entry::Kind::tick));
  BOOST_TEST(!d.journal_of_other.take(entry));
}

BOOST_AUTO_TEST_CASE(copies_are_made_one_after_the_other_and_a_task_that_throws_is_called_again) {
  Desk d;
  Copy_task<Scene> first(4000, 8000), second(4000, 8000), small(10, 8000);
  d.ask(Command::Kind::task, 1, &first);
  d.ask(Command::Kind::task, 2, &second);
  d.ask(Command::Kind::task, 3, &small);
  for (int k = 0; k < 20; ++k)
    d.tick();
  BOOST_TEST((d.answers() == Tickets{1, 2, 3}));
  BOOST_TEST((first.copy.is_whole() && second.copy.is_whole() && !small.copy.is_whole()));
  BOOST_TEST((surface_of(second.copy) == surface_of(*d.scene)));
  struct Throwing : Counting {
    using Counting::Counting;
    bool go_on(Scene& scene, Tool_type& tool) override {
      if (!Counting::go_on(scene, tool))
        throw Error("not yet");
      return true;
    }
  } throwing(3);
  d.ask(Command::Kind::task, 4, &throwing);
  BOOST_CHECK_THROW(d.tick(), Error);
  BOOST_CHECK_THROW(d.tick(), Error);
  d.tick();
  BOOST_TEST((d.answers() == Tickets{4}));
}

} // namespace
