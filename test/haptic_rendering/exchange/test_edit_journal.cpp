// SPDX-License-Identifier: GPL-3.0-or-later
#include "haptic_rendering/exchange/made_again.h"
#include "sculpting/public_functions/Callers_mode.h"

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <functional>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>

using namespace haptic_sculpt;
using namespace exchange_tests;

namespace {

struct Calling_visitor : Default_edit_visitor {
  std::function<void()> when_moved;
  void vertex_moved(Mesh::Vertex_index) {
    if (when_moved)
      when_moved();
  }
};

BOOST_AUTO_TEST_CASE(a_removal_where_a_probe_stands_is_told_as_the_collapse_that_it_was) {
  std::mt19937_64 random(haptic_sculpt::test::seed_from_environment(23));
  std::uniform_real_distribution<double> number(-1, 1);
  const auto random_vector = [&] {
    const double x = number(random), y = number(random), z = number(random);
    return Vector3d(x, y, z);
  };
  std::size_t removed = 0, kept = 0;
  for (int round = 0; round < 200; ++round) {
    Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.12));
    // A pit whose rim is no plane: which neighbour its bottom is drawn into says what is passed over near the rim.
    const Mesh::Vertex_index bottom(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
    Vector3d middle = Vector3d::Zero();
    {
      Sculptor<Mesh> sculptor(mesh);
      for (const auto w : mesh.vertices_around_target(mesh.halfedge(bottom))) {
        const Vector3d to = internal::vector_of(mesh.point(w)) + 0.1 * random_vector();
        sculptor.grab(w).drag_to(internal::point_of<Mesh::Point>(to));
        middle += internal::vector_of(mesh.point(w)) / mesh.degree(bottom);
      }
      sculptor.grab(bottom).drag_to(internal::point_of<Mesh::Point>(0.8 * middle));
    }
    Scene scene(mesh, [](const Vector3d&, const Vector3d&) { return map_of_tests; });
    Tool<Scene::Sculptor_type> tool(scene.sculptor, map_of_tests, 0.01, 0.001);
    Edit_journal journal(100);
    tool.keep_journal(&journal);
    const Vector3d hand = map_of_tests.to_device(middle + 0.08 * random_vector());
    tool.move(hand, 0); // puts the probe there, if that is outside
    if (!tool.holds_probe() || tool.move(hand, 2).event != Tool_event::removed)
      continue;
    ++removed;
    kept += tool.holds_probe() && bool(*tool.probe()); // placed again, where it was or at the hand
    Entries entries(1);
    BOOST_TEST(journal.take(entries[0]));
    BOOST_TEST((entries[0].kind == Edit_kind::collapse));
    Mesh alone = mesh;
    Sculptor<Mesh> sculptor(alone);
    const auto made = sculptor.remove(sculptor.vertex(entries[0].vertices[0]));
    BOOST_TEST((made && sculptor.id(*made.vertex) == entries[0].vertices[1])); // a probe is in nobody's way
    BOOST_TEST((made_again(mesh, entries) == surface_of(scene)));
  }
  BOOST_TEST_MESSAGE(removed << " removals, after which a probe went on " << kept << " times");
  BOOST_TEST(removed >= 50u);
  BOOST_TEST(kept >= 50u);
}

/// Throws while `throws` is set.
struct Throwing_visitor : Default_edit_visitor {
  std::shared_ptr<bool> throws = std::make_shared<bool>(false);
  void throw_if() const {
    if (*throws)
      throw std::runtime_error("the visitor throws");
  }
  void vertex_moved(Mesh::Vertex_index) { throw_if(); }
  void face_created(Mesh::Face_index) { throw_if(); }
};

// What stands then is in no journal: what comes after it cannot be made again.
BOOST_AUTO_TEST_CASE(a_journal_breaks_off_where_an_edit_stands_that_it_was_not_told) {
  for (const std::string what : {"drag", "move if free", "move", "shift", "creation", "flip", "nothing"})
    BOOST_TEST_CONTEXT(what) {
      Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.12));
      Throwing_visitor visitor;
      Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Throwing_visitor> sculptor(mesh, Sculptor_parameters(), visitor);
      Edit_journal journal(100);
      Journaled_edits edits(sculptor);
      edits.keep_journal(&journal);
      const Mesh::Vertex_index v(17);
      const Mesh::Point p = mesh.point(v), target(1.1 * p.x(), 1.1 * p.y(), 1.1 * p.z()), far(1e305, 0, 0);
      const auto e = *mesh.edges_begin();
      const auto stroke = sculptor.stroke();
      BOOST_TEST(edits.move_if_free(Mesh::Vertex_index(18), mesh.point(Mesh::Vertex_index(18)) + (target - p) / 100));
      const Surface before = surface_of(mesh, sculptor); // the next edit makes no step of its own
      *visitor.throws = true;
      const auto edit = [&] {
        if (what == "drag")
          edits.drag(v, target);
        else if (what == "move if free")
          edits.move_if_free(v, target);
        else if (what == "move")
          edits.make(Edit::of(Edit_kind::move, {sculptor.id(v), 0, 0}, {target.x(), target.y(), target.z()}));
        else if (what == "shift") {
          Edit wanted = Edit::of(Edit_kind::shift);
          wanted.axis = 0, wanted.ways = {{sculptor.id(v), target.x()}};
          edits.make(wanted);
        } else if (what == "creation")
          edits.insert_on_edge(e, CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
        else if (what == "flip")
          edits.flip(e);
        else
          edits.drag(v, far); // throws before anything is done
      };
      BOOST_CHECK_THROW(edit(), std::exception);
      BOOST_TEST((surface_of(mesh, sculptor) == before) == (what == "nothing"));
      BOOST_TEST(journal.has_overrun() == (what != "nothing"));
    }
}

BOOST_AUTO_TEST_CASE(a_drag_by_a_grab_that_somebody_has_ended_is_no_move) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.12));
  Sculptor<Mesh> sculptor(mesh);
  Edit_journal journal(100);
  Journaled_edits edits(sculptor);
  edits.keep_journal(&journal);
  auto grab = sculptor.grab(Mesh::Vertex_index(17));
  const auto other = sculptor.grab(Mesh::Vertex_index(18));
  BOOST_TEST((edits.drag(grab, Mesh::Point(2, 2, 2), std::nullopt).end == Drag_end::stale));
  journal.end_tick(0);
  Edit taken;
  BOOST_TEST((!journal.take(taken) && !journal.has_overrun()));
}

BOOST_AUTO_TEST_CASE(a_drag_within_which_its_grab_goes_elsewhere_is_told) {
  using Calling_sculptor = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Calling_visitor>;
  for (const bool ends : {false, true}) {
    Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.12));
    Calling_sculptor sculptor(mesh);
    Edit_journal journal(100);
    Journaled_edits<Calling_sculptor> edits(sculptor);
    edits.keep_journal(&journal);
    auto stale = sculptor.grab(Mesh::Vertex_index(18)), grab = sculptor.grab(Mesh::Vertex_index(17));
    sculptor.visitor().when_moved = [&] {
      if (ends)
        const auto taken = std::move(grab);
      else
        edits.drag(stale, Mesh::Point(0, 0, 0), std::nullopt);
    };
    const Mesh::Point p = mesh.point(Mesh::Vertex_index(17));
    edits.drag(grab, Mesh::Point(1.1 * p.x(), 1.1 * p.y(), 1.1 * p.z()), std::nullopt);
    BOOST_TEST((mesh.point(Mesh::Vertex_index(17)) != p));
    journal.end_tick(0);
    Edit taken;
    BOOST_TEST((journal.take(taken) && taken.kind == Edit_kind::move && taken.vertices[0] == 17u));
    BOOST_TEST(!journal.has_overrun());
  }
}

BOOST_AUTO_TEST_CASE(moves_by_subnormal_lengths_are_told_to_callers_who_flush_them) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.12));
  const double unit = 0x1p-1074;
  for (const auto v : mesh.vertices()) {
    const auto p = mesh.point(v);
    mesh.point(v) = {std::round(1e5 * p.x()) * unit, std::round(1e5 * p.y()) * unit, std::round(1e5 * p.z()) * unit};
  }
  Sculptor<Mesh> sculptor(mesh);
  Edit_journal journal(100);
  Journaled_edits edits(sculptor);
  edits.keep_journal(&journal);
  {
    const haptic_sculpt::test::Callers_mode mode(FE_TONEAREST, true);
    const auto out = [&](std::uint32_t v) {
      const auto p = mesh.point(Mesh::Vertex_index(v));
      return Mesh::Point(p.x(), p.y(), std::copysign(2e5 * unit, p.z()));
    };
    edits.move_if_free(Mesh::Vertex_index(17), out(17));
    edits.drag(Mesh::Vertex_index(90), out(90));
  }
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 2u);
  journal.end_tick(0);
  std::size_t moves = 0;
  for (Edit entry; journal.take(entry);)
    moves += entry.kind == Edit_kind::move;
  BOOST_TEST(moves == 2u);
}

// A slide of several legs is one step of undo, and so it is where it is made again; an undo ends the stroke, even one
// that is refused.
BOOST_AUTO_TEST_CASE(what_a_journal_has_is_undone_in_the_same_steps_where_it_is_made_again) {
  std::mt19937_64 random(haptic_sculpt::test::seed_from_environment(5));
  std::uniform_real_distribution<double> number(-1.5, 1.5);
  std::size_t slides = 0, refused = 0;
  for (int round = 0; round < 100; ++round) {
    Mesh mesh = meshes::to_mesh(meshes::icosphere(1)), again = mesh;
    Sculptor<Mesh> sculptor(mesh), other(again);
    Edit_journal journal(1000);
    Journaled_edits edits(sculptor);
    edits.keep_journal(&journal);
    for (int k = 0; k < 8; ++k)
      switch (random() % 8) {
      case 0:
        edits.begin_stroke();
        break;
      case 1:
        edits.end_stroke();
        break;
      case 2:
      case 3:
        refused += !edits.make(Edit::of(Edit_kind::undo));
        break;
      case 4:
        refused += !edits.make(Edit::of(Edit_kind::redo));
        break;
      default: {
        const double x = number(random), y = number(random), z = number(random);
        slides += edits.drag(Mesh::Vertex_index(random() % 42), Mesh::Point(x, y, z)).legs > 1;
      }
      }
    edits.end_stroke();
    journal.end_tick(0);
    for (Edit taken; journal.take(taken);)
      if (taken.kind != Edit_kind::none)
        other.apply(taken);
    BOOST_TEST((surface_of(again, other) == surface_of(mesh, sculptor)), "round " << round);
    BOOST_TEST(other.history().number_of_undo_steps() == sculptor.history().number_of_undo_steps());
    BOOST_TEST(other.history().number_of_redo_steps() == sculptor.history().number_of_redo_steps());
  }
  BOOST_TEST_MESSAGE(slides << " slides, " << refused << " undo and redo refused");
  BOOST_TEST(slides > 50u);
  BOOST_TEST(refused > 50u);
}

BOOST_AUTO_TEST_CASE(a_journal_that_breaks_off_has_the_ticks_before) {
  Edit_journal journal(100);
  const Edit move = Edit::of(Edit_kind::move, {3, 0, 0}, {1, 2, 3});
  journal.add(move), journal.end_tick(0);
  journal.add(move), journal.break_off(), journal.end_tick(1);
  journal.add(move), journal.end_tick(2);
  BOOST_TEST(journal.has_overrun());
  std::vector<Edit_kind> kinds;
  for (Edit taken; journal.take(taken);)
    kinds.push_back(taken.kind);
  // The last has no end: nothing of it counts.
  BOOST_TEST((kinds == std::vector<Edit_kind>{Edit_kind::move, Edit_kind::none, Edit_kind::move}));
}

BOOST_AUTO_TEST_CASE(a_journal_that_is_not_written_in_time_ends_at_the_end_of_a_tick) {
  Edit move, taken;
  move.kind = Edit_kind::move;
  { // too old: a tick waits, and nothing else happens
    Edit_journal journal(100);
    journal.add(move);
    journal.end_tick(5);
    for (std::uint64_t tick = 6; tick <= 104; ++tick) {
      journal.end_tick(tick);
      BOOST_TEST(journal.age(tick) <= 100u);
      BOOST_TEST(!journal.has_overrun());
    }
    journal.end_tick(105);
    BOOST_TEST(journal.has_overrun());
    journal.add(move);
    BOOST_TEST(journal.lost() == 1u);
  }
  { // too many: the tick that finds no room is not ended
    Edit_journal journal(100, 1);
    BOOST_TEST(journal.room() == 102u);
    std::uint64_t tick = 0;
    for (; !journal.has_overrun(); ++tick) {
      for (int k = 0; k < 10; ++k)
        journal.add(move);
      journal.end_tick(tick);
    }
    BOOST_TEST(journal.room() == 0u);
    std::uint64_t whole = 0, rest = 0;
    while (journal.take(taken)) {
      ++rest;
      if (taken.kind == Edit_kind::none) {
        BOOST_TEST(taken.vertices[0] == whole);
        ++whole, rest = 0;
      }
    }
    BOOST_TEST(whole == tick - 1);
    BOOST_TEST(rest < 11u);
    BOOST_TEST(journal.lost() > 0u);
  }
  { // in time: nothing ends
    Edit_journal journal(100);
    for (std::uint64_t tick = 0; tick < 5000; ++tick) {
      journal.add(move);
      journal.end_tick(tick);
      while (tick % 90 == 0 && journal.take(taken))
        journal.wrote(taken.kind == Edit_kind::none);
    }
    BOOST_TEST(!journal.has_overrun());
    BOOST_TEST(journal.lost() == 0u);
  }
}

BOOST_AUTO_TEST_CASE(a_journal_tells_the_age_that_it_was_given) {
  BOOST_TEST(Edit_journal(70).most_age() == 70u);
}

} // namespace
