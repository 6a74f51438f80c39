// SPDX-License-Identifier: GPL-3.0-or-later
// What a tool lets go of by itself, and what it does not bring then.
#include "haptic_rendering/Tool_bench.h"
#include "sculpting/edits/failing_allocations.h"

#include <boost/test/unit_test.hpp>

#include <optional>
#include <string>

using namespace haptic_sculpt;
using namespace exchange_tests;

namespace {

/// Of a vertex a little off the first face.
template <class Sculptor>
Edit creation_on_a_face(const Sculptor& sculptor) {
  const Mesh& mesh = sculptor.mesh();
  Edit wanted = Edit::of(Edit_kind::insert_on_face);
  Vector3d middle = Vector3d::Zero();
  int k = 0;
  for (const auto corner : mesh.vertices_around_face(mesh.halfedge(*mesh.faces_begin())))
    wanted.vertices[k++] = sculptor.id(corner), middle += internal::vector_of(mesh.point(corner)) / 3;
  middle *= 1.1;
  wanted.point = {middle[0], middle[1], middle[2]};
  return wanted;
}

BOOST_AUTO_TEST_CASE(a_vertex_that_is_not_there_is_not_taken_and_begins_no_step) {
  Tool_bench bench;
  BOOST_CHECK_THROW(bench.tool.take(Mesh::Vertex_index(100000)), Unknown_vertex);
  for (const std::uint32_t v : {3, 5}) // each a step of its own
    bench.tool.edit_by([&](auto& edits) {
      return edits.move_if_free(Mesh::Vertex_index(v),
                                internal::point_of<Mesh::Point>(1.01 * bench.place(Mesh::Vertex_index(v))));
    });
  BOOST_TEST(bench.scene->sculptor.history().number_of_undo_steps() == 2u);
  BOOST_TEST(bench.is_made_again());
}

// Where memory runs out between a creation and its taking, no stroke stays open that nobody ends.
BOOST_AUTO_TEST_CASE(a_created_vertex_that_cannot_be_taken_begins_no_step_for_what_comes) {
  int created_and_not_taken = 0;
  for (std::size_t n = 1;; ++n) {
    Mesh mesh = ball;
    Sculptor<Mesh> sculptor(mesh); // a Loop_scene has made room for all
    Tool<Sculptor<Mesh>> tool(sculptor, map_of_tests, 0.01, 0.001);
    const Edit wanted = creation_on_a_face(sculptor);
    bool is_taken = false;
    try {
      const test::Failing_allocations nth(n, false);
      is_taken = static_cast<bool>(tool.create_and_take(wanted));
    } catch (const std::bad_alloc&) {
    }
    if (is_taken)
      break;
    const std::size_t before = sculptor.history().number_of_undo_steps();
    created_and_not_taken += before != 0;
    BOOST_TEST(!tool.holds_vertex());
    for (const std::uint32_t v : {3, 5}) // each a step of its own
      BOOST_REQUIRE(tool.edit_by([&](auto& edits) {
        const Vector3d place = internal::vector_of(mesh.point(Mesh::Vertex_index(v)));
        return edits.move_if_free(Mesh::Vertex_index(v), internal::point_of<Mesh::Point>(1.01 * place));
      }));
    BOOST_TEST(sculptor.history().number_of_undo_steps() == before + 2);
  }
  BOOST_TEST(created_and_not_taken > 0);
}

// Nor where a removal of what is in hand is not made.
BOOST_AUTO_TEST_CASE(a_removal_that_runs_out_of_memory_ends_the_step_of_what_was_in_hand) {
  int thrown = 0;
  for (std::size_t n = 1;; ++n) {
    Mesh mesh = ball;
    Sculptor<Mesh> sculptor(mesh);
    Tool<Sculptor<Mesh>> tool(sculptor, map_of_tests, 0.01, 0.001);
    tool.take(Mesh::Vertex_index(17));
    const Vector3d hand = map_of_tests.to_device(internal::vector_of(mesh.point(Mesh::Vertex_index(17))));
    tool.move(hand, 0);
    bool is_done = false;
    try {
      const test::Failing_allocations nth(n, false);
      tool.move(hand, 2);
      is_done = true;
    } catch (const std::bad_alloc&) {
    }
    if (is_done)
      break;
    ++thrown;
    BOOST_TEST(!tool.holds_vertex());
    for (const std::uint32_t v : {3, 5})
      BOOST_REQUIRE(tool.edit_by([&](auto& edits) {
        const Vector3d place = internal::vector_of(mesh.point(Mesh::Vertex_index(v)));
        return edits.move_if_free(Mesh::Vertex_index(v), internal::point_of<Mesh::Point>(1.01 * place));
      }));
    BOOST_TEST(sculptor.history().number_of_undo_steps() == 2u);
  }
  BOOST_TEST(thrown > 0);
}

// An Edit object may have been that of a move before.
BOOST_AUTO_TEST_CASE(legs_of_what_is_no_move_are_not_told) {
  Tool_bench bench;
  Edit wanted = creation_on_a_face(bench.scene->sculptor);
  wanted.legs.push_back({9, 9, 9});
  BOOST_REQUIRE(static_cast<bool>(bench.tool.edit(wanted)));
  BOOST_TEST(bench.is_made_again());
}

// A Sculptor has one hand, and whoever has it may use it beside the tool.
BOOST_AUTO_TEST_CASE(a_vertex_that_somebody_else_takes_or_removes_is_let_go_of_without_a_force) {
  for (const std::string how : {"taken", "removed", "undone"})
    for (const int button : {0, 1, 2})
      BOOST_TEST_CONTEXT(how << ", then button " << button) {
        Tool_bench bench;
        auto& sculptor = bench.scene->sculptor;
        const Mesh::Vertex_index v(17);
        const Vector3d hand = 1.2 * bench.place(v);
        std::optional<Scene::Sculptor_type::Grab_type> other;
        if (how == "undone") {
          BOOST_REQUIRE(static_cast<bool>(bench.tool.create_and_take(creation_on_a_face(bench.scene->sculptor))));
        } else {
          bench.tool.take(v);
        }
        bench.move(hand);
        BOOST_TEST(bench.tool.holds_vertex());
        if (how == "taken")
          other.emplace(sculptor.grab(Mesh::Vertex_index(5)));
        else if (how == "removed")
          BOOST_REQUIRE(static_cast<bool>(sculptor.remove(v)));
        else
          BOOST_REQUIRE(static_cast<bool>(sculptor.undo()));
        BOOST_TEST(!bench.tool.holds_vertex());
        const Mesh before = bench.scene->mesh;
        const Vector3d far = 3 * hand;
        for (int k = 0; k < 40; ++k) {
          const Tool_step step = bench.tool.move(map_of_tests.to_device(far), button);
          BOOST_TEST(step.reached); // no spring
          BOOST_TEST(step.contacts == 0);
        }
        BOOST_TEST(!bench.tool.holds_vertex());
        BOOST_TEST(bench.tool.holds_probe());
        BOOST_TEST((surface_of(before, sculptor) == surface_of(*bench.scene)));
      }
}

BOOST_AUTO_TEST_CASE(the_step_of_a_button_ends_with_its_release_even_where_a_task_has_taken_the_vertex_out_of_hand) {
  Tool_bench bench;
  auto& sculptor = bench.scene->sculptor;
  const Vector3d hand = map_of_tests.to_device(1.05 * bench.place(Mesh::Vertex_index(17)));
  bench.tool.move(hand, 0);
  bench.tool.move(hand, 1);
  BOOST_REQUIRE(bench.tool.holds_vertex());
  const auto push = [&](std::uint32_t vertex) {
    const Mesh::Vertex_index v(vertex);
    const Vector3d out = 1.02 * bench.place(v);
    bench.tool.edit_by([&](auto& edits) { return edits.move_if_free(v, internal::point_of<Mesh::Point>(out)); });
  };
  push(3);
  bench.tool.move(hand, 0);
  const Mesh before = bench.scene->mesh;
  push(40);
  BOOST_TEST(static_cast<bool>(sculptor.undo()));
  BOOST_TEST((surface_of(before, sculptor) == surface_of(*bench.scene)));
}

BOOST_AUTO_TEST_CASE(a_probe_that_is_not_carried_is_not_brought_where_a_vertex_is_let_go_of_by_the_button) {
  for (const int button : {0, 2}) {
    Tool_bench bench;
    bench.tool.carry_probe(false);
    const Vector3d hand = bench.place(Mesh::Vertex_index(17));
    for (int k = 0; k < 3; ++k)
      bench.tool.move(map_of_tests.to_device(hand), 1);
    BOOST_TEST(bench.tool.holds_vertex());
    for (int k = 0; k < 40; ++k) {
      bench.tool.move(map_of_tests.to_device(1.5 * hand), button);
      BOOST_TEST(!bench.tool.probe());
    }
    BOOST_TEST((button == 2 ? bench.tool.edits().removed : bench.tool.edits().released) == 1u);
  }
}

// By others: of what is in hand nothing is read where it may be no more.
BOOST_AUTO_TEST_CASE(a_vertex_in_hand_is_not_looked_for_in_a_mesh_with_fewer_elements) {
  for (const bool clears : {false, true})
    for (int way = 0; way < 7; ++way)
      BOOST_TEST_CONTEXT("clears " << clears << ", way " << way) {
        Mesh mesh = ball;
        Sculptor<Mesh> sculptor(mesh);
        Pose_loop<Sculptor<Mesh>> loop(sculptor, map_of_tests, parameters_of_tests());
        Tool<Sculptor<Mesh>> tool(sculptor, map_of_tests, 0.01, 0.001);
        const Mesh::Vertex_index v(static_cast<Mesh::size_type>(mesh.number_of_vertices() - 1));
        Pose_reading reading;
        reading.position = map_of_tests.to_device(internal::vector_of(mesh.point(v))), reading.elapsed = 0.001;
        loop.tick(reading);
        if (way < 4) {
          loop.tool().take(v);
          loop.tick(reading);
        } else {
          tool.move(reading.position, 0), tool.move(reading.position, 1);
          BOOST_REQUIRE(tool.holds_vertex());
        }
        loop.open_clutch(way == 1);
        if (clears) {
          mesh.clear();
        } else {
          mesh = meshes::to_mesh(meshes::tetrahedron());
        }
        switch (way) {
        case 0:
        case 1:
          BOOST_TEST((loop.tick(reading).fault == Loop_fault::error));
          BOOST_TEST(std::string(loop.failure()).find("behind the Sculptor's back") != std::string::npos);
          break;
        case 2:
          BOOST_CHECK_THROW(loop.zoom(2), Mesh_changed);
          break;
        case 3:
          BOOST_CHECK_THROW(loop.tool().place(), Mesh_changed);
          break;
        case 4:
          BOOST_CHECK_THROW(tool.move(reading.position, 0), Mesh_changed);
          break;
        case 5:
          BOOST_CHECK_THROW(tool.move(reading.position, 2), Mesh_changed);
          break;
        default:
          BOOST_CHECK_THROW(tool.move(reading.position, 1), Mesh_changed);
        }
        if (way == 4 || way == 5)
          BOOST_TEST(!tool.holds_vertex());
      }
}

} // namespace
