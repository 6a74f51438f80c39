// SPDX-License-Identifier: GPL-3.0-or-later
// Where a session, a scene or a journal ends and another one begins.
#include "haptic_rendering/exchange/Queue_bench.h"

#include <boost/test/unit_test.hpp>

#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

using namespace haptic_sculpt;
using namespace exchange_tests;

namespace {

BOOST_AUTO_TEST_CASE(another_scene_is_entered_once_no_task_is_under_way_and_with_a_journal_of_its_own) {
  Queue d(true);
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
  BOOST_TEST(d.queue.ask(enter));
  d.ask(Command::Kind::task, 5, &later);
  for (int k = 0; k < 4; ++k)
    d.tick();
  BOOST_TEST((d.answers() == Tickets{3, 4, 5}));
  BOOST_TEST((two.seen == d.scene.get() && later.seen == d.other.get()));
  BOOST_TEST(d.session.journal() == &d.journal_of_other);
  Edit entry, last_edit;
  while (d.journal.take(entry))
    if (entry.kind != Edit_kind::none)
      last_edit = entry;
  BOOST_TEST((last_edit.kind == Edit_kind::end)); // what was held in the old scene, ends there
  BOOST_TEST((entry.kind == Edit_kind::none));
  BOOST_TEST(!d.journal_of_other.take(entry));
}

BOOST_AUTO_TEST_CASE(a_session_that_ends_answers_what_is_under_way_and_leaves_the_rest_to_the_next) {
  for (const bool is_told : {true, false}) {
    Queue d;
    std::optional<Session> session;
    session.emplace(d.loop, *d.scene, &d.queue, nullptr, nullptr);
    Counting endless(1 << 30);
    d.ask(Command::Kind::task, 1, &endless);
    d.ask(Command::Kind::enter, 2);
    d.ask(Command::Kind::let_go, 3);
    for (int k = 0; k < 5; ++k)
      session->tick(reading_at(session->ticks()));
    BOOST_TEST(d.answers().empty());
    if (is_told)
      session->end();
    session.reset();
    Loop_answer<Scene> answer;
    BOOST_TEST((d.queue.take(answer) && answer.ticket == 1u && !answer.done && answer.task == &endless));
    BOOST_TEST((d.queue.take(answer) && answer.ticket == 2u && !answer.done && answer.left == d.other.get()));
    BOOST_TEST(std::string(answer.failure.data()) == "the session has ended");
    BOOST_TEST(!d.queue.take(answer));
    d.tick();
    BOOST_TEST((d.answers() == Tickets{3}));
    BOOST_TEST(d.last.done);
    BOOST_TEST(d.queue.waiting() == 0u);
  }
}

BOOST_AUTO_TEST_CASE(the_scene_that_is_sculpted_cannot_be_entered_and_is_not_given_back) {
  Queue d;
  Command enter;
  enter.kind = Command::Kind::enter, enter.scene = d.scene.get();
  BOOST_TEST(d.queue.ask(enter));
  d.tick();
  BOOST_TEST(d.answers().size() == 1u);
  BOOST_TEST((!d.last.done && d.last.left == nullptr && d.last.failure[0] != 0));
  BOOST_TEST(&d.session.scene() == d.scene.get());
}

BOOST_AUTO_TEST_CASE(a_viewer_is_passed_all_of_a_scene_that_is_entered_again) {
  Queue d;
  Scene_feed feed;
  Session session(d.loop, *d.scene, &d.queue, &feed, nullptr);
  std::map<std::uint32_t, Face_change> shown;
  std::uint32_t scene = 0;
  const auto run = [&] {
    for (int k = 0; k < 40; ++k)
      session.tick(reading_at(session.ticks()));
    for (Face_change face; feed.take(face);)
      show(face, shown, scene);
    BOOST_TEST((surface_of(shown) == surface_of(session.scene())));
  };
  run();
  BOOST_REQUIRE(static_cast<bool>(d.scene->sculptor.remove(*d.scene->mesh.vertices_begin())));
  run();
  for (std::uint32_t k = 1; k <= 4; ++k) {
    Command enter;
    enter.kind = Command::Kind::enter, enter.scene = k % 2 == 1 ? d.other.get() : d.scene.get();
    BOOST_TEST(d.queue.ask(enter));
    run();
    BOOST_TEST(scene == k);
  }
}

/// A caller's value that cannot be copied while `throws` is set.
struct Value {
  static inline bool throws = false;
  Value() = default;
  Value(const Value&) { check(); }
  Value& operator=(const Value&) {
    check();
    return *this;
  }
  static void check() {
    if (throws)
      throw std::runtime_error("a value was not copied");
  }
};

// The mesh has grown by a vertex, and half of its properties have not.
BOOST_AUTO_TEST_CASE(a_sculptor_that_an_edit_leaves_unfinished_is_a_fault_and_the_viewer_sees_it) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(1, 0.12));
  mesh.add_property_map<Mesh::Vertex_index, Value>("v:of others", Value());
  Scene scene(mesh, [](const Vector3d&, const Vector3d&) { return map_of_tests; });
  Loop loop(scene.sculptor, scene.map, parameters_of_tests());
  Command_queue<Scene> queue(4);
  Scene_feed feed;
  Session session(loop, scene, &queue, &feed, nullptr);
  session.tick(reading_at(0));
  const auto h = scene.mesh.halfedge(*scene.mesh.edges_begin());
  const auto p = CGAL::midpoint(scene.mesh.point(scene.mesh.source(h)), scene.mesh.point(scene.mesh.target(h)));
  Command command;
  command.kind = Command::Kind::edit;
  command.edit = Edit::of(Edit_kind::insert_on_edge,
                          {scene.sculptor.id(scene.mesh.source(h)), scene.sculptor.id(scene.mesh.target(h)), 0},
                          {p.x(), p.y(), p.z()});
  BOOST_TEST(queue.ask(command));
  Value::throws = true;
  session.tick(reading_at(1));
  Value::throws = false;
  Loop_answer<Scene> answer;
  BOOST_TEST((queue.take(answer) && !answer.done));
  BOOST_CHECK_THROW(scene.sculptor.undo(), Unfinished_change);
  BOOST_TEST((session.tick(reading_at(2)).fault == Loop_fault::error));
  Tick_view last;
  for (Tick_view view; feed.take(view);)
    last = view;
  BOOST_TEST(last.tick == 2u);
  BOOST_TEST((last.fault == Loop_fault::error));
  static_assert(noexcept(session.pass_faces_on()), "a thread may call it between two ticks");
  Copy_task<Scene> copying(4000, 8000);
  command = Command();
  command.kind = Command::Kind::task, command.task = &copying;
  BOOST_TEST(queue.ask(command));
  session.tick(reading_at(3));
  BOOST_TEST((queue.take(answer) && !answer.done)); // it is the asking thread's again, and nobody else knows it
  BOOST_TEST((scene.sculptor.visitor().copy() == nullptr));
}

// A log holds what its journal says: an undo must not go back beyond it.
BOOST_AUTO_TEST_CASE(a_journal_that_begins_where_nothing_can_be_undone_is_made_again) {
  Queue d;
  Command move, undo;
  move.kind = undo.kind = Command::Kind::edit;
  undo.edit = Edit::of(Edit_kind::undo);
  const auto v = *d.scene->mesh.vertices_begin();
  const auto p = d.scene->mesh.point(v);
  move.edit = Edit::of(Edit_kind::move, {d.scene->sculptor.id(v), 0, 0}, {1.3 * p.x(), 1.3 * p.y(), 1.3 * p.z()});
  BOOST_TEST(d.queue.ask(move));
  d.tick();
  d.loop.tool().take(v); // the session begins while something is in hand
  BOOST_TEST(d.answers().size() == 1u);
  BOOST_TEST(d.scene->sculptor.history().number_of_undo_steps() == 1u);
  d.scene->sculptor.forget_history();
  BOOST_TEST(d.scene->sculptor.history().number_of_undo_steps() == 0u);
  const Mesh begin = d.scene->mesh;
  std::vector<Edit> entries;
  {
    Session session(d.loop, *d.scene, &d.queue, nullptr, &d.journal);
    BOOST_TEST(!d.loop.tool().holds_vertex());
    for (const bool can_be : {false, true}) {
      move.edit.point = {p.x(), p.y(), p.z()}; // back
      if (can_be)
        BOOST_TEST(d.queue.ask(move));
      BOOST_TEST(d.queue.ask(undo));
      session.tick(reading_at(0)), session.tick(reading_at(1));
      d.answers();
      BOOST_TEST(d.last.done == can_be);
    }
    session.end();
  }
  for (Edit entry; d.journal.take(entry);)
    entries.push_back(entry);
  BOOST_TEST((made_again(begin, entries) == surface_of(*d.scene)));
}

// Whoever asked may destroy it, and edits go on.
BOOST_AUTO_TEST_CASE(a_copy_under_way_is_told_nothing_any_more_once_its_session_has_ended) {
  Queue d;
  auto copying = std::make_unique<Copy_task<Scene>>(4000, 8000);
  copying->copy.begin();
  d.scene->sculptor.visitor().tell_to(&copying->copy); // as in the midst of a large mesh
  d.session.end();
  BOOST_TEST(d.scene->sculptor.visitor().copy() == nullptr);
  copying.reset();
  BOOST_TEST(static_cast<bool>(d.scene->sculptor.remove(*d.scene->mesh.vertices_begin())));
  Session next(d.loop, *d.scene, &d.queue, nullptr, nullptr);
  Copy_task<Scene> again(4000, 8000);
  d.ask(Command::Kind::task, 1, &again);
  for (int k = 0; k < 20; ++k)
    next.tick(reading_at(next.ticks()));
  BOOST_TEST((d.answers() == Tickets{1}));
}

BOOST_AUTO_TEST_CASE(a_viewer_of_another_session_is_passed_all_faces) {
  Queue d;
  for (int round = 0; round < 2; ++round) {
    Scene_feed feed;
    Session session(d.loop, *d.scene, &d.queue, &feed, nullptr);
    for (int k = 0; k < 40; ++k)
      session.tick(reading_at(session.ticks()));
    std::map<std::uint32_t, Face_change> shown;
    std::uint32_t scene = 0;
    for (Face_change face; feed.take(face);)
      show(face, shown, scene);
    BOOST_TEST((surface_of(shown) == surface_of(*d.scene)));
  }
}

BOOST_AUTO_TEST_CASE(a_journal_that_nobody_writes_ends_the_run) {
  Queue d(true);
  d.loop.tool().take(*d.scene->mesh.vertices_begin());
  for (int k = 0; k < 1100 && d.loop.interaction().fault() == Loop_fault::none; ++k)
    d.tick();
  BOOST_TEST(d.journal.has_overrun());
  BOOST_TEST((d.loop.interaction().fault() == Loop_fault::log));
  d.tick();
  BOOST_TEST(!d.loop.tool().holds_vertex());
  d.loop.restart(); // told once
  d.loop.tool().take(*d.scene->mesh.vertices_begin());
  for (int k = 0; k < 10; ++k)
    d.tick();
  BOOST_TEST(d.loop.tool().holds_vertex());
  BOOST_TEST((d.loop.interaction().fault() == Loop_fault::none));
}

// Who asks for a restart does not know yet of what has come at the end of the tick before.
BOOST_AUTO_TEST_CASE(a_restart_that_was_asked_for_before_an_overrun_was_seen_does_not_hide_it) {
  Queue d(true);
  d.loop.tool().take(*d.scene->mesh.vertices_begin());
  for (int k = 0; k < 1100 && !d.journal.has_overrun(); ++k)
    d.tick();
  BOOST_REQUIRE((d.loop.interaction().fault() == Loop_fault::log));
  d.ask(Command::Kind::restart, 1);
  d.tick();
  BOOST_TEST((d.loop.interaction().fault() == Loop_fault::log)); // once more
  d.tick();                                                      // which says so
  d.ask(Command::Kind::restart, 2);
  for (int k = 0; k < 10; ++k)
    d.tick();
  BOOST_TEST((d.loop.interaction().fault() == Loop_fault::none));
}

BOOST_AUTO_TEST_CASE(an_overrun_that_no_tick_has_said_is_said_in_the_scene_that_is_entered) {
  for (const bool is_in_hand : {false, true}) { // it overruns by the tick before, or when what is held is let go of
    Queue d(true);
    d.loop.tool().take(*d.scene->mesh.vertices_begin());
    for (int k = 0; k < 1100 && !d.journal.has_overrun() && !(is_in_hand && d.session.ticks() == 1000); ++k)
      d.tick();
    BOOST_REQUIRE(d.journal.has_overrun() == !is_in_hand);
    Command enter;
    enter.kind = Command::Kind::enter, enter.scene = d.other.get(), enter.journal = &d.journal_of_other;
    BOOST_TEST(d.queue.ask(enter));
    d.tick();
    BOOST_TEST(d.answers().size() == 1u);
    BOOST_TEST((d.last.done && d.last.left == d.scene.get() && &d.session.scene() == d.other.get()));
    BOOST_TEST(d.journal.has_overrun());
    BOOST_TEST((d.loop.interaction().fault() == Loop_fault::log));
    d.loop.restart();
    for (int k = 0; k < 10; ++k) // once
      d.tick();
    BOOST_TEST((d.loop.interaction().fault() == Loop_fault::none));
  }
}

// Of faults the first stays: what is lost is said after it has been seen to.
BOOST_AUTO_TEST_CASE(a_journal_that_overruns_beside_another_fault_ends_the_run_after_the_restart) {
  for (const bool is_restarted_at_once : {false, true}) {
    Queue d(true);
    d.loop.tool().take(*d.scene->mesh.vertices_begin());
    for (int k = 0; k < 1100 && !d.journal.has_overrun(); ++k) {
      if (k == 900 && !is_restarted_at_once)
        d.loop.end_by(Loop_fault::late);
      d.tick();
    }
    BOOST_REQUIRE(d.journal.has_overrun());
    BOOST_TEST((d.loop.interaction().fault() == (is_restarted_at_once ? Loop_fault::log : Loop_fault::late)));
    d.loop.restart();
    int told = 0;
    for (int k = 0; k < 10; ++k) {
      told += d.session.tick(reading_at(d.session.ticks())).fault == Loop_fault::log;
      d.loop.restart();
    }
    BOOST_TEST(told == 1); // by a tick: a restart before it takes back nothing
  }
}

BOOST_AUTO_TEST_CASE(a_session_that_is_replaced_leaves_its_successor_the_journal) {
  Queue d;
  const auto session_with = [&d](Edit_journal& journal) {
    return std::make_unique<Session>(d.loop, *d.scene, &d.queue, nullptr, &journal);
  };
  auto session = session_with(d.journal);
  session = session_with(d.journal_of_other); // made before the first is destroyed
  std::size_t edits = 0;
  for (int k = 0; k < 700; ++k) {
    session->tick(reading_at(session->ticks()));
    for (Edit entry; d.journal_of_other.take(entry);)
      edits += entry.kind != Edit_kind::none;
  }
  BOOST_TEST(edits > 10u);
  auto& tool = d.loop.tool();
  const auto move_is_told = [&] {
    const auto& p = d.scene->mesh.point(decltype(d.scene->mesh)::Vertex_index(0));
    tool.edit(Edit::of(Edit_kind::move, {0, 0, 0}, {1.01 * p.x(), 1.01 * p.y(), 1.01 * p.z()}));
    d.journal.end_tick(0);
    bool is_told = false;
    for (Edit entry; d.journal.take(entry);)
      is_told |= entry.kind == Edit_kind::move;
    return is_told;
  };
  const std::uint64_t first = tool.keep_journal(&d.journal), second = tool.keep_journal(&d.journal);
  tool.end_journal(first);
  BOOST_TEST(move_is_told());
  tool.end_journal(second);
  BOOST_TEST(!move_is_told());
}

} // namespace
