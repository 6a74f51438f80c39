// SPDX-License-Identifier: GPL-3.0-or-later
// What a tool is asked for between two ticks, and that its journal makes all of it again.
#include "haptic_rendering/Tool_bench.h"

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <random>

using namespace haptic_sculpt;
using namespace exchange_tests;

namespace {

BOOST_AUTO_TEST_CASE(a_vertex_that_is_taken_is_anchored_where_it_is_and_held_in_one_stroke) {
  Tool_bench bench;
  const Mesh::Vertex_index v(17);
  const Vector3d before = bench.place(v), hand(3, 1, 2);
  bench.tool.carry_probe(false);
  BOOST_TEST(bench.move(hand).reached);
  BOOST_TEST(!bench.tool.vertex().is_valid());
  bench.tool.take(v);
  const Tool_step step = bench.move(hand);
  BOOST_TEST(bench.tool.holds_vertex());
  BOOST_TEST((step.target - before).norm() <= 1e-15);
  for (int k = 1; k <= 100; ++k)
    bench.move(hand + 0.004 * k * before);
  BOOST_TEST((bench.place(v) - 1.4 * before).norm() <= 1e-12);
  BOOST_TEST((bench.tool.last_drag() && bench.tool.last_drag()->reached));
  const Tool_step blocked = bench.move(hand - 3 * before); // through all of the ball, and out on the other side
  BOOST_TEST(!blocked.reached);
  BOOST_TEST((bench.tool.last_drag() && !bench.tool.last_drag()->reached));
  BOOST_TEST((internal::vector_of(bench.tool.last_drag()->position) == bench.place(v)));
  bench.tool.let_go();
  BOOST_TEST(!bench.tool.last_drag());
  BOOST_TEST(!bench.tool.holds_vertex());
  BOOST_TEST(bench.scene->sculptor.history().number_of_undo_steps() == 1u);
  BOOST_TEST(bench.is_made_again());
  BOOST_TEST(static_cast<bool>(bench.tool.edit(Edit::of(Edit_kind::undo, {0, 0, 0}))));
  BOOST_TEST((bench.place(v) == before));
}

BOOST_AUTO_TEST_CASE(a_probe_that_is_not_carried_is_in_hand_from_when_it_is_taken_until_something_lets_go) {
  Tool_bench bench;
  bench.tool.carry_probe(false);
  const Vector3d hand(0.3, 0, 0);
  const auto probe = [&bench] { return internal::vector_of(bench.tool.probe()->position()); };
  bench.move(hand);
  BOOST_TEST(!bench.tool.probe());
  BOOST_TEST(!bench.tool.take_probe({0.1, 0, 0})); // inside
  BOOST_TEST(!bench.move(hand).end);
  BOOST_TEST(bench.tool.take_probe({0, 0, 1.5}));
  for (int k = 0; k < 1000; ++k) // the offset does not fade
    bench.move(hand);
  BOOST_REQUIRE(bench.tool.holds_probe());
  BOOST_TEST((probe() - Vector3d(0, 0, 1.5)).norm() <= 1e-15);
  const Tool_step pressed = bench.move(hand - Vector3d(0, 0, 1));
  BOOST_TEST(!pressed.reached);
  BOOST_TEST(pressed.contacts > 0);
  BOOST_TEST(probe()[2] > 0.8);
  bench.tool.let_go();
  BOOST_TEST(!bench.tool.holds_probe());
  bench.tool.carry_probe(true);
  BOOST_TEST(bench.move({0, 0, 1.6}).reached);
  BOOST_TEST((probe() == Vector3d(0, 0, 1.6)));
  BOOST_TEST(bench.scene->sculptor.history().number_of_undo_steps() == 0u);
}

BOOST_AUTO_TEST_CASE(a_probe_goes_on_after_edits_where_it_was_or_else_at_the_hand) {
  Tool_bench bench;
  const Mesh::Vertex_index v(17);
  const Vector3d home = bench.place(v), out = 1.3 * home;
  bench.move(out);
  for (int k = 0; k < 100; ++k)
    bench.move(out - 0.01 * k * home); // pressed against the vertex, or beside it
  const auto probe = [&bench] { return internal::vector_of(bench.tool.probe()->position()); };
  const Vector3d pressed = probe();
  BOOST_REQUIRE(static_cast<bool>(bench.tool.edit(Edit::of(Edit_kind::remove, {90, 0, 0})))); // far from it
  BOOST_TEST(!*bench.tool.probe());
  BOOST_TEST((bench.move(0.4 * home).end == Drag_end::reached)); // anchored where it is
  BOOST_REQUIRE((bench.tool.holds_probe() && bool(*bench.tool.probe())));
  BOOST_TEST((probe() - pressed).norm() <= 0.02 * 0.01 * map_of_tests.scale()); // 0.02 of the reach
  // Lifted, the vertex drawn over where it stands, and let go of: it comes back off the surface.
  for (int k = 0; k < 100; ++k)
    bench.move(0.4 * home + 0.02 * k * home);
  const Vector3d above = probe();
  bench.tool.take(v);
  BOOST_TEST(!bench.tool.probe());
  bench.move(above);
  for (int k = 0; k < 100; ++k)
    bench.move(above + 0.02 * k * home);
  BOOST_TEST((bench.place(v).norm() > above.norm()));
  bench.tool.let_go();
  bench.move(0.9 * home); // inside of the solid by now: there is no probe until the hand comes out
  BOOST_TEST(!bench.tool.holds_probe());
  bench.move(bench.place(v) + home);
  BOOST_TEST((bench.tool.holds_probe() && (probe() - bench.place(v) - home).norm() <= 1e-12));
}

// However the strokes before it have begun, each ends once in the journal, and undo finds the same.
BOOST_AUTO_TEST_CASE(a_press_while_a_stroke_is_under_way_ends_that) {
  for (int way = 0; way < 3; ++way) {
    Tool_bench bench;
    const Mesh::Vertex_index v(17), w(30);
    const auto press = [&](Mesh::Vertex_index held, int button, double height) {
      return bench.tool.move(map_of_tests.to_device(Vector3d(height * bench.place(held))), button);
    };
    press(v, 0, 1.001);
    if (way == 0)
      bench.tool.take(v);
    else if (way == 1)
      bench.tool.begin_stroke();
    else
      press(v, 1, 1.001), press(v, 1, 1.01), press(v, 3, 1.001); // two buttons, then one again
    BOOST_TEST((press(v, 1, 1.001).event == Tool_event::grabbed));
    press(v, 1, 1.02);
    press(v, 0, 1.02);
    for (int k = 0; k < 40; ++k)
      press(w, 0, 1.3 - 0.007 * k);
    BOOST_TEST((press(w, 1, 1.001).event == Tool_event::grabbed));
    press(w, 1, 1.02);
    press(w, 0, 1.02);
    BOOST_TEST(static_cast<bool>(bench.tool.edit(Edit::of(Edit_kind::undo))));
    BOOST_TEST(bench.is_made_again());
  }
}

BOOST_AUTO_TEST_CASE(moves_by_value_are_told_as_their_legs) {
  Tool_bench bench;
  std::mt19937_64 random(haptic_sculpt::test::seed_from_environment(6));
  std::uniform_real_distribution<double> number(-1, 1);
  std::size_t slides = 0;
  for (int k = 0; k < 100; ++k) { // through the ball, most of them
    const Edit wanted =
        Edit::of(Edit_kind::move, {random() % 160, 0, 0}, {number(random), number(random), number(random)});
    const auto made = bench.tool.edit(wanted);
    slides += !made.edit.legs.empty();
  }
  BOOST_TEST(slides >= 20u);
  const std::size_t steps = bench.scene->sculptor.history().number_of_undo_steps();
  for (std::size_t k = 0; k < steps; k += 2)
    BOOST_TEST(bool(bench.tool.edit(Edit::of(Edit_kind::undo)))); // as many steps again
  BOOST_TEST(bench.is_made_again());
}

BOOST_AUTO_TEST_CASE(edits_and_moves_of_many_are_made_again_by_what_the_journal_says) {
  std::mt19937_64 random(haptic_sculpt::test::seed_from_environment(5));
  for (const bool carries : {true, false}) {
    Tool_bench bench;
    bench.tool.carry_probe(carries);
    const auto& sculptor = bench.scene->sculptor;
    std::size_t done[4] = {};
    for (int round = 0; round < 200; ++round) {
      bench.move({0.4 * (round % 5), 1.3, 0.2});
      const Mesh& mesh = bench.scene->mesh;
      const Mesh::Face_index f(static_cast<Mesh::size_type>(random() % mesh.num_faces()));
      if (mesh.is_removed(f))
        continue;
      const auto h = mesh.halfedge(f);
      const std::size_t a = sculptor.id(mesh.source(h)), b = sculptor.id(mesh.target(h));
      switch (random() % 4) {
      case 0:
        done[0] += static_cast<bool>(bench.tool.edit(Edit::of(Edit_kind::flip, {a, b, 0})));
        break;
      case 1:
        done[1] += static_cast<bool>(bench.tool.edit(Edit::of(Edit_kind::collapse, {a, b, 0})));
        break;
      case 2: {
        Edit wanted = creation_at(
            sculptor, {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))},
            (bench.place(mesh.source(h)) + bench.place(mesh.target(h)) + bench.place(mesh.target(mesh.next(h)))) / 3);
        const auto made = bench.tool.create_and_take(wanted);
        done[2] += static_cast<bool>(made);
        BOOST_TEST(bench.tool.holds_vertex() == static_cast<bool>(made));
        for (int k = 0; made && k < 5; ++k)
          bench.move({0.4 * (round % 5), 1.3 + 0.01 * k, 0.2});
        break;
      }
      default: { // two parts of a dab in one stroke, with a vertex in the middle that others hold back
        std::map<Mesh::Vertex_index, Mesh::Point> places;
        const boost::associative_property_map<decltype(places)> targets(places);
        std::vector<Mesh::Vertex_index> vertices;
        for (const auto v : mesh.vertices_around_target(h)) {
          vertices.push_back(v);
          places[v] = internal::point_of<Mesh::Point>((round % 3 == 0 ? -0.5 : 0.97) * bench.place(v));
        }
        const std::size_t steps = sculptor.history().number_of_undo_steps();
        bench.tool.begin_stroke();
        const auto moved = [&](auto first, auto last) {
          return bench.tool.edit_by([&](auto& edits) {
            return move_vertices(edits, std::vector(first, last), targets, Move_parameters().drags(false));
          });
        };
        const Move_report first = moved(vertices.begin(), vertices.begin() + 2),
                          second = moved(vertices.begin() + 2, vertices.end());
        bench.tool.let_go();
        BOOST_TEST(sculptor.history().number_of_undo_steps() <= steps + 1);
        done[3] += first.reached + second.reached;
      }
      }
    }
    bench.tool.let_go();
    for (const std::size_t n : done)
      BOOST_TEST(n >= 10u);
    BOOST_TEST(bench.is_made_again());
  }
}

BOOST_AUTO_TEST_CASE(functions_that_take_a_sculptor_take_edits_of_a_tool_and_are_made_again) {
  using Kernel = CGAL::Kernel_traits<Mesh::Point>::Kernel;
  Tool_bench bench;
  auto& sculptor = bench.scene->sculptor;
  const Mesh& mesh = bench.scene->mesh;
  const auto steps = [&] { return sculptor.history().number_of_undo_steps(); };
  const auto remeshed = bench.tool.edit_by([&](auto& edits) { return isotropic_remeshing(edits, 0.2); });
  BOOST_TEST((remeshed.splits.done > 20 && remeshed.flips.done > 0 && remeshed.moves.done > 20));
  std::vector<Mesh::Face_index> above;
  for (const auto f : mesh.faces())
    if (mesh.point(mesh.target(mesh.halfedge(f))).z() > 0)
      above.push_back(f);
  const auto coarser = bench.tool.edit_by([&](auto& edits) { return isotropic_remeshing(above, edits, 0.5); });
  BOOST_TEST(coarser.collapses.done > 5);
  BOOST_TEST(steps() == 2u); // each is one
  bench.tool.begin_stroke();
  const Dab_3<Kernel> dab{Brush_kind::inflate, {0, 0, 1}, 0.7, 0.2};
  for (int k = 0; k < 3; ++k)
    bench.tool.edit_by([&](auto& edits) { return apply_brush(edits, std::vector{dab, dab}); });
  bench.tool.let_go();
  BOOST_TEST(steps() == 3u); // a stroke is one, too
  const std::vector<Mesh::Vertex_index> all(mesh.vertices().begin(), mesh.vertices().end());
  const auto turned = bench.tool.edit_by([&](auto& edits) {
    return move_rigidly(edits, all, CGAL::Aff_transformation_3<Kernel>(0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0));
  });
  BOOST_TEST(turned.share == 1);
  const std::vector<Mesh::Vertex_index> half(all.begin(), std::next(all.begin(), all.size() / 2));
  const auto jammed = bench.tool.edit_by([&](auto& edits) {
    return move_rigidly(edits, half, CGAL::Aff_transformation_3<Kernel>(CGAL::TRANSLATION, Kernel::Vector_3(-2, 1, 1)));
  });
  BOOST_TEST((jammed.share < 1 && !jammed.contacts.empty()));
  BOOST_TEST(bool(bench.tool.edit(Edit::of(Edit_kind::undo))));
  BOOST_TEST(bool(bench.tool.edit(Edit::of(Edit_kind::undo))));
  const auto held = bench.tool.edit_by([&](auto& edits) { // an edit that changes nothing is none
    const Kernel::Vector_3 far(-2e4, 1e4, 1e4);
    return move_rigidly(edits, half, CGAL::Aff_transformation_3<Kernel>(CGAL::TRANSLATION, far));
  });
  BOOST_TEST((held.share == 0 && !held.contacts.empty()));
  BOOST_TEST(bool(bench.tool.edit(Edit::of(Edit_kind::redo))));
  BOOST_TEST(bench.is_made_again());
}

BOOST_AUTO_TEST_CASE(an_object_is_in_the_journal_as_shifts_within_one_stroke) {
  using Kernel = CGAL::Kernel_traits<Mesh::Point>::Kernel;
  Tool_bench bench;
  const std::vector<Mesh::Vertex_index> all(ball.vertices().begin(), ball.vertices().end());
  const Kernel::Vector_3 way(3, 5, 7);
  bench.tool.edit_by([&](auto& edits) {
    return move_rigidly(edits, all, CGAL::Aff_transformation_3<Kernel>(CGAL::TRANSLATION, way));
  });
  Entries entries;
  for (Edit entry; bench.journal.take(entry);)
    entries.push_back(entry);
  BOOST_REQUIRE(entries.size() == 5u);
  BOOST_TEST((entries.front().kind == Edit_kind::stroke && entries.back().kind == Edit_kind::end));
  for (int axis = 0; axis < 3; ++axis) {
    const Edit& shift = entries[1 + axis];
    BOOST_TEST((shift.kind == Edit_kind::shift && shift.axis == axis && shift.ways.size() == all.size()));
    for (const auto& [id, end] : shift.ways)
      BOOST_TEST(end == ball.point(all[id])[axis] + way[axis]);
  }
}

BOOST_AUTO_TEST_CASE(the_last_push_is_the_normal_of_what_was_touched_last) {
  Mesh mesh = meshes::to_mesh(meshes::box(1, 1)); // [0, 1]^3
  Sculptor<Mesh> sculptor(mesh);
  Tool<Sculptor<Mesh>> tool(sculptor, map_of_tests, 0.001, 0.001);
  BOOST_TEST(tool.last_push() == Vector3d(0, 0, 1)); // up where nothing was touched
  const auto press = [&](const Vector3d& from, const Vector3d& to) {
    for (int k = 0; k <= 200; ++k)
      tool.move(map_of_tests.to_device(from + (to - from) * k / 200.0), 0);
  };
  press(Vector3d(1.3, 0.4, 0.55), Vector3d(0.9, 0.4, 0.55));
  BOOST_TEST((tool.last_push() - Vector3d(1, 0, 0)).norm() <= 1e-12);
  press(Vector3d(0.9, 0.4, 0.55), Vector3d(1.3, 0.4, 0.55));
  BOOST_TEST((tool.last_push() - Vector3d(1, 0, 0)).norm() <= 1e-12); // nothing is touched on the way back
  press(Vector3d(1.3, 0.4, 0.55), Vector3d(1.3, 1.3, 0.55));
  press(Vector3d(1.3, 1.3, 0.55), Vector3d(0.6, 1.3, 0.55));
  press(Vector3d(0.6, 1.3, 0.55), Vector3d(0.6, 0.8, 0.55));
  BOOST_TEST((tool.last_push() - Vector3d(0, 1, 0)).norm() <= 1e-12);
}

BOOST_AUTO_TEST_CASE(under_another_map_what_is_held_stays_and_goes_on_at_the_other_scale) {
  Mesh mesh = meshes::to_mesh(meshes::box(1, 1)); // [0, 1]^3
  Sculptor<Mesh> sculptor(mesh);
  const auto corner = *mesh.vertices().begin();
  const auto place = [&] { return internal::vector_of(mesh.point(corner)); };
  Tool<Sculptor<Mesh>> tool(sculptor, map_of_tests, 0.001, 0.001);
  const Vector3d at_first = place(), out = 2 * at_first - Vector3d::Ones(); // away from the middle of the box
  tool.take(corner);
  Vector3d handle = map_of_tests.to_device(at_first);
  tool.move(handle, 0), tool.move(handle, 0);
  BOOST_TEST(place() == at_first);
  tool.move(handle += 0.001 * out, 0); // m
  BOOST_TEST((place() - at_first - 0.05 * out).norm() <= 1e-12); // 50 units a metre
  const Vector3d before = place();
  tool.change_map(Workspace_map(200, Vector3d::Zero(), Vector3d(7, 8, 9), Vector3d::Zero()));
  tool.move(handle, 0);
  BOOST_TEST((place() - before).norm() <= 1e-12); // the hand and its way to it, in rounded numbers
  tool.move(handle += 0.0005 * out, 0);
  BOOST_TEST((place() - before - 0.1 * out).norm() <= 1e-12);
  BOOST_TEST((tool.vertex() == corner));
}

} // namespace
