// SPDX-License-Identifier: GPL-3.0-or-later
// What a function of the caller's tries with a tool in the middle of a call of it is refused, and takes nothing out of
// the hand: neither a stroke ends within an edit, nor is the journal another than the history.
#include "haptic_rendering/Tool_bench.h"

#include <boost/property_map/function_property_map.hpp>
#include <boost/test/unit_test.hpp>

#include <functional>
#include <vector>

using namespace haptic_sculpt;
using namespace exchange_tests;

namespace {

struct Hearing_visitor : Default_edit_visitor {
  std::function<void()> heard;
  void vertex_moved(Mesh::Vertex_index) {
    if (heard)
      heard();
  }
};
using Heard_sculptor = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Hearing_visitor>;
using Heard_tool = Tool<Heard_sculptor>;

const Edit undo = Edit::of(Edit_kind::undo);

const std::vector<std::function<void(Heard_tool&)>> tries = {
    [](auto& tool) { tool.let_go(); },
    [](auto& tool) { tool.take(Mesh::Vertex_index(5)); },
    [](auto& tool) { tool.take_probe(Vector3d(3, 3, 3)); },
    [](auto& tool) {
      tool.create_and_take(Edit::of(Edit_kind::insert_on_edge, {0, 1, 0}));
    },
    [](auto& tool) { tool.edit(undo); },
    [](auto& tool) { tool.begin_stroke(); },
    [](auto& tool) { tool.edit_by([](auto& edits) { edits.make(undo); }); },
    [](auto& tool) { tool.keep_journal(nullptr); }};

struct Heard_bench {
  Mesh mesh = ball;
  Heard_sculptor sculptor{mesh};
  Heard_tool tool{sculptor, map_of_tests, 0.01, 0.001};
  Edit_journal journal{100000};
  int refused = 0;
  Heard_bench() { tool.keep_journal(&journal); }

  void refuse(const std::function<void(Heard_tool&)>& attempt) {
    BOOST_CHECK_THROW(attempt(tool), Reentrant_call);
    ++refused;
  }
  bool is_made_again() {
    Entries entries;
    for (Edit entry; journal.take(entry);)
      entries.push_back(entry);
    return made_again(ball, entries) == surface_of(mesh, sculptor);
  }
};

BOOST_AUTO_TEST_CASE(a_visitor_takes_nothing_out_of_the_hand_that_moves_it) {
  for (std::size_t which = 0; which < tries.size(); ++which)
    BOOST_TEST_CONTEXT("try " << which) {
      Heard_bench bench;
      const Mesh::Vertex_index v(17);
      const Vector3d hand = internal::vector_of(bench.mesh.point(v));
      bench.tool.take(v);
      bench.tool.move(map_of_tests.to_device(hand), 0);
      bench.tool.move(map_of_tests.to_device(Vector3d(1.02 * hand)), 0);
      bench.sculptor.visitor().heard = [&] { bench.refuse(tries[which]); };
      bench.tool.move(map_of_tests.to_device(Vector3d(1.05 * hand)), 0);
      bench.sculptor.visitor().heard = nullptr;
      BOOST_TEST(bench.refused == 1);
      BOOST_TEST((bench.tool.vertex() == v));
      bench.tool.let_go();
      BOOST_TEST(bench.sculptor.history().number_of_undo_steps() == 1u);
      bench.tool.edit(undo);
      BOOST_TEST(bench.is_made_again());
    }
}

BOOST_AUTO_TEST_CASE(a_progress_function_does_not_end_the_step_of_its_call) {
  for (std::size_t which = 0; which < tries.size(); ++which)
    BOOST_TEST_CONTEXT("try " << which) {
      Heard_bench bench;
      const auto targets = boost::make_function_property_map<Mesh::Vertex_index>(
          [&bench](Mesh::Vertex_index v) { return bench.mesh.point(v) + meshes::Kernel::Vector_3(0.3, 0.1, 0.2); });
      bench.tool.edit_by([&](auto& edits) {
        const auto progress = [&](const Move_progress&) {
          if (bench.refused == 0) {
            BOOST_CHECK_THROW(edits.begin_stroke(), Reentrant_call);
            BOOST_CHECK_THROW(edits.make_in_stroke(undo), Reentrant_call);
            bench.refuse(tries[which]);
          }
          return true;
        };
        return move_vertices(edits, bench.mesh.vertices(), targets, Move_parameters().drags(false).progress(progress));
      });
      BOOST_TEST(bench.refused == 1);
      BOOST_TEST(bench.sculptor.history().number_of_undo_steps() == 1u);
      BOOST_TEST(bench.is_made_again());
    }
}

// An edit lets go first, so that no stroke is under way.
BOOST_AUTO_TEST_CASE(nor_does_a_visitor_of_an_edit_change_to_whom_it_is_told) {
  for (std::size_t which = 0; which < tries.size(); ++which)
    BOOST_TEST_CONTEXT("try " << which) {
      Heard_bench bench;
      const Vector3d to = 1.02 * internal::vector_of(bench.mesh.point(Mesh::Vertex_index(17)));
      bench.tool.move(map_of_tests.to_device(Vector3d(3, 3, 3)), 0);
      bench.sculptor.visitor().heard = [&] { bench.refuse(tries[which]); };
      bench.tool.edit(Edit::of(Edit_kind::move, {17, 0, 0}, {to[0], to[1], to[2]}));
      bench.sculptor.visitor().heard = nullptr;
      BOOST_TEST(bench.refused == 1);
      BOOST_TEST(bench.tool.holds_probe());
      BOOST_TEST(bench.sculptor.history().number_of_undo_steps() == 1u);
      BOOST_TEST(bench.is_made_again());
    }
}

// Who holds the loop's thread for long may make its ticks meanwhile: a probe only looks. A fault lets go when it can.
BOOST_AUTO_TEST_CASE(a_loop_goes_on_within_an_edit_and_lets_go_after_it) {
  for (const bool has_fault : {false, true}) {
    Mesh mesh = ball;
    Sculptor<Mesh> sculptor(mesh);
    Pose_loop<Sculptor<Mesh>> loop(sculptor, map_of_tests, parameters_of_tests());
    Pose_reading reading;
    reading.position = map_of_tests.to_device(Vector3d(0, 0, 3)), reading.elapsed = 0.001;
    loop.tick(reading);
    std::size_t ticks = 0;
    loop.tool().edit_by([&](auto& edits) {
      const auto progress = [&](const Move_progress&) {
        if (has_fault && ticks == 0)
          loop.end_by(Loop_fault::late);
        ++ticks;
        reading.button = 1; // which waits
        BOOST_TEST((loop.tick(reading).fault == (has_fault ? Loop_fault::late : Loop_fault::none)));
        return true;
      };
      const auto targets = boost::make_function_property_map<Mesh::Vertex_index>(
          [&](Mesh::Vertex_index v) { return mesh.point(v) + meshes::Kernel::Vector_3(0.3, 0.1, 0.2); });
      return move_vertices(edits, mesh.vertices(), targets, Move_parameters().drags(false).progress(progress));
    });
    BOOST_TEST(ticks > 0u);
    BOOST_TEST(loop.tool().edits().refused == 0u);
    BOOST_TEST(sculptor.history().number_of_undo_steps() == 1u);
    loop.tool().take(Mesh::Vertex_index(17));
    reading.button = 0;
    loop.tick(reading);
    BOOST_TEST(loop.tool().holds_vertex() == !has_fault);
    BOOST_TEST(loop.tool().edits().grabbed == (has_fault ? 0u : 1u));
  }
}

} // namespace
