// SPDX-License-Identifier: GPL-3.0-or-later
// Strokes and limits of the history against a list of all states that were ever reached.
#include "sculpting/Mesh_snapshot.h"
#include "sculpting/edits/random_edits.h"

#include <boost/test/unit_test.hpp>

#include <map>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Stroke_type = Sculptor<Mesh>::Stroke_type;

Point_3 moved_by(const Mesh& mesh, Vertex_index v, double x) {
  return mesh.point(v) + meshes::Kernel::Vector_3(x, 0.5 * x, -x);
}

/// What a history without limits has to be: the states between steps.
struct State_list {
  std::vector<Mesh_snapshot> states;
  std::size_t now = 0;
  bool is_in_stroke = false, has_step = false;

  void changed(Mesh_snapshot state) {
    if (!is_in_stroke || !has_step) {
      states.resize(++now);
      states.push_back(std::move(state));
      has_step = is_in_stroke;
    } else {
      states.resize(now);
      states.push_back(std::move(state));
    }
  }
};

} // namespace

BOOST_AUTO_TEST_CASE(a_stroke_is_one_step) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.3, 0.05));
  Sculptor<Mesh> sculptor(mesh);
  const Mesh_snapshot begin = snapshot(sculptor);
  const History_view history = sculptor.history();
  {
    const auto stroke = sculptor.stroke();
    BOOST_TEST(stroke.is_open());
    for (int i = 0; i < 100; ++i)
      for (const std::size_t v : {3, 50, 4})
        BOOST_TEST(sculptor.grab(Vertex_index(v))
                       .drag_to(moved_by(mesh, Vertex_index(v), i % 2 == 0 ? 0.01 : -0.009))
                       .reached);
    BOOST_TEST(history.number_of_undo_steps() == 1u);
  }
  BOOST_TEST(history.bytes() == 3 * 56 + 16u); // a record a vertex
  const Mesh_snapshot moved = snapshot(sculptor);
  {
    auto outer = sculptor.stroke();
    sculptor.grab(Vertex_index(3)).drag_to(moved_by(mesh, Vertex_index(3), 0.01));
    {
      const auto inner = sculptor.stroke();
      BOOST_REQUIRE(static_cast<bool>(
          sculptor.flip(sculptor.edge_of(0, static_cast<std::size_t>(mesh.source(mesh.halfedge(Vertex_index(0))))))));
    }
    BOOST_TEST(outer.is_open());
    sculptor.grab(Vertex_index(3)).drag_to(moved_by(mesh, Vertex_index(3), 0.01));
    BOOST_REQUIRE(static_cast<bool>(sculptor.remove(Vertex_index(90))));
    auto other = std::move(outer);
    BOOST_TEST(!outer.is_open());
    BOOST_TEST(other.is_open());
    other.end();
    BOOST_TEST(!other.is_open());
    other.end();
  }
  BOOST_TEST(history.number_of_undo_steps() == 2u);
  const Mesh_snapshot end = snapshot(sculptor);
  { // an empty stroke is no step; one that is undone in has ended
    const auto empty = sculptor.stroke();
  }
  BOOST_TEST(history.number_of_undo_steps() == 2u);
  {
    const auto stroke = sculptor.stroke();
    sculptor.grab(Vertex_index(7)).drag_to(moved_by(mesh, Vertex_index(7), 0.01));
    sculptor.grab(Vertex_index(8)).drag_to(moved_by(mesh, Vertex_index(8), 0.01));
    BOOST_REQUIRE(static_cast<bool>(sculptor.undo()));
    BOOST_TEST(!stroke.is_open());
    BOOST_TEST((snapshot(sculptor) == end));
    BOOST_REQUIRE(static_cast<bool>(sculptor.undo()));
    BOOST_TEST((snapshot(sculptor) == moved));
    BOOST_REQUIRE(static_cast<bool>(sculptor.redo()));
    BOOST_TEST((snapshot(sculptor) == end));
    sculptor.grab(Vertex_index(7)).drag_to(moved_by(mesh, Vertex_index(7), 0.01));
    sculptor.grab(Vertex_index(8)).drag_to(moved_by(mesh, Vertex_index(8), 0.01));
    BOOST_TEST(history.number_of_undo_steps() == 4u);
    const auto another = sculptor.stroke();
    BOOST_TEST(another.is_open());
  }
  try {
    const auto stroke = sculptor.stroke();
    sculptor.grab(Vertex_index(7)).drag_to(moved_by(mesh, Vertex_index(7), 0.01));
    sculptor.grab(Vertex_index(8)).drag_to(moved_by(mesh, Vertex_index(8), 0.01));
    sculptor.grab(Vertex_index(8)).drag_to(Point_3(0, std::nan(""), 0));
  } catch (const Non_finite_point&) {
  }
  BOOST_TEST(history.number_of_undo_steps() == 5u);
  for (int i = 0; i < 3; ++i)
    sculptor.undo();
  BOOST_TEST((snapshot(sculptor) == end));
  sculptor.undo();
  BOOST_TEST((snapshot(sculptor) == moved));
  sculptor.undo();
  BOOST_TEST((snapshot(sculptor) == begin));
  BOOST_TEST(!sculptor.undo());
  BOOST_TEST(history.number_of_redo_steps() == 5u);
}

BOOST_AUTO_TEST_CASE(the_history_is_bounded) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.3, 0.05));
  Sculptor<Mesh> sculptor(mesh);
  const History_view history = sculptor.history();
  const auto drag = [&](std::size_t v) {
    sculptor.grab(Vertex_index(v)).drag_to(moved_by(mesh, Vertex_index(v), 0.001));
  };
  sculptor.set_history_limit({3, History_limit().bytes});
  std::vector<Mesh_snapshot> states;
  for (std::size_t v = 0; v < 8; ++v) {
    states.push_back(snapshot(sculptor));
    drag(v);
  }
  BOOST_TEST(history.number_of_undo_steps() == 3u);
  BOOST_TEST(history.bytes() == 3 * 72u);
  sculptor.undo();
  sculptor.undo();
  BOOST_TEST((snapshot(sculptor) == states[6]));
  sculptor.set_history_limit({2, History_limit().bytes}); // one undone, two to redo: the oldest goes first
  BOOST_TEST(history.number_of_undo_steps() == 0u);
  BOOST_TEST(history.number_of_redo_steps() == 2u);
  BOOST_TEST(static_cast<bool>(sculptor.redo()));
  sculptor.set_history_limit({1, History_limit().bytes});
  BOOST_TEST(history.number_of_undo_steps() == 0u);
  BOOST_TEST(history.number_of_redo_steps() == 1u);
  BOOST_TEST(static_cast<bool>(sculptor.redo()));
  BOOST_TEST((history.number_of_undo_steps() == 1u && history.number_of_redo_steps() == 0u));

  sculptor.set_history_limit({History_limit().steps, 5 * 56 + 16});
  drag(1);
  { // five moves fit, six do not
    const auto stroke = sculptor.stroke();
    for (std::size_t v = 10; v < 15; ++v)
      drag(v);
  }
  BOOST_TEST(history.number_of_undo_steps() == 1u);
  BOOST_TEST(history.bytes() == 5 * 56 + 16u);
  const Mesh_snapshot before = snapshot(sculptor);
  {
    const auto stroke = sculptor.stroke();
    for (std::size_t v = 10; v < 16; ++v)
      drag(v);
    drag(16);
    BOOST_TEST(history.number_of_undo_steps() == 0u);
  }
  BOOST_TEST((sculptor.undo().refusal->reason == Refusal_reason::nothing_to_undo));
  BOOST_TEST((snapshot(sculptor) != before));
  const Mesh_snapshot later = snapshot(sculptor);
  drag(17);
  BOOST_TEST(static_cast<bool>(sculptor.undo()));
  BOOST_TEST((snapshot(sculptor) == later));
  BOOST_TEST((sculptor.undo().refusal->reason == Refusal_reason::nothing_to_undo));
  BOOST_TEST(static_cast<bool>(sculptor.redo()));

  sculptor.set_history_limit(History_limit::off());
  BOOST_TEST(history.bytes() == 0u);
  drag(1);
  {
    const auto stroke = sculptor.stroke();
    drag(2);
    sculptor.remove(Vertex_index(90));
  }
  BOOST_TEST((sculptor.undo().refusal->reason == Refusal_reason::nothing_to_undo));
  BOOST_TEST((sculptor.redo().refusal->reason == Refusal_reason::nothing_to_redo));
  sculptor.set_history_limit(History_limit::none());
  const Mesh_snapshot off = snapshot(sculptor);
  drag(1);
  BOOST_TEST(static_cast<bool>(sculptor.undo()));
  BOOST_TEST((snapshot(sculptor) == off));
}

BOOST_AUTO_TEST_CASE(edits_in_strokes_keep_every_promise_and_undo_to_the_bit) {
  Random random(seed_from_environment(37));
  const std::size_t edits = count_from_environment("HAPTIC_SCULPT_STROKE_EDITS", 12000), every = 1000;
  std::map<int, std::size_t> done;
  std::size_t differs = 0, invalid = 0, total = 0, strokes = 0, most_steps = 0;
  for (std::size_t batch = 0; total < edits; ++batch) {
    meshes::Triangle_list list =
        batch % 2 == 0 ? meshes::bumpy_sphere(1, 0.3, 0.05, static_cast<std::uint32_t>(batch)) : meshes::torus(7, 5);
    list += meshes::icosphere(0).scale_and_move(0.4, 2, 0, 0);
    Mesh mesh = meshes::to_mesh(list);
    Sculptor<Mesh> sculptor(mesh);
    const std::size_t limit = batch % 3 == 2 ? 20 : History_limit().steps;
    sculptor.set_history_limit({limit, History_limit().bytes});
    State_list expected;
    expected.states.push_back(snapshot(sculptor));
    std::vector<Stroke_type> open;
    for (int i = 0; i < 3000; ++i, ++total) {
      if (random() % 8 == 0 && open.size() < 3) {
        open.push_back(sculptor.stroke());
        if (!expected.is_in_stroke)
          expected.is_in_stroke = true, expected.has_step = false, ++strokes;
      }
      if (random() % 16 == 0 && !open.empty()) {
        const std::size_t which = random() % open.size(); // in any order
        open.erase(open.begin() + static_cast<std::ptrdiff_t>(which));
        expected.is_in_stroke = expected.is_in_stroke &&
                                std::any_of(open.begin(), open.end(), [](const Stroke_type& s) { return s.is_open(); });
      }
      const std::size_t vertices = mesh.number_of_vertices();
      const Random_edit edit = random_edit(sculptor, random);
      done[edit.kind] += edit.is_done;
      if (edit.kind == Random_edit::undo || edit.kind == Random_edit::redo) {
        expected.is_in_stroke = false;
        const bool is_undo = edit.kind == Random_edit::undo;
        if (edit.is_done)
          is_undo ? --expected.now : ++expected.now;
        else if (!is_undo || limit > expected.states.size())
          differs += is_undo ? expected.now != 0 : expected.now + 1 != expected.states.size();
        differs += expected.now >= expected.states.size() || snapshot(sculptor) != expected.states[expected.now];
      } else if (edit.is_done) {
        expected.changed(snapshot(sculptor));
      }
      if (limit > 20)
        differs += sculptor.history().number_of_undo_steps() != expected.now;
      else
        differs += sculptor.history().number_of_undo_steps() > limit;
      if (mesh.number_of_vertices() > 300 || vertices < 20)
        while (sculptor.undo()) // neither without end nor to nothing
          --expected.now, expected.is_in_stroke = false;
      if (total % every == every - 1)
        invalid += !validate(mesh).is_valid();
    }
    open.clear();
    most_steps = std::max(most_steps, sculptor.history().number_of_undo_steps());
    while (sculptor.redo())
      ++expected.now;
    differs += expected.now + 1 != expected.states.size();
    while (sculptor.undo())
      differs += snapshot(sculptor) != expected.states[--expected.now];
    differs += limit > 20 && expected.now != 0;
    while (sculptor.redo())
      differs += snapshot(sculptor) != expected.states[++expected.now];
    differs += expected.now + 1 != expected.states.size();
    invalid += !validate(mesh).is_valid() || !mesh.is_valid(false);
    sculptor.check_unchanged();
  }
  BOOST_TEST_MESSAGE(total << " edits, " << strokes << " strokes, up to " << most_steps << " steps");
  for (const auto& [kind, count] : done)
    BOOST_TEST_MESSAGE("  kind " << kind << ": " << count << " done");
  BOOST_TEST(differs == 0u);
  BOOST_TEST(invalid == 0u);
  for (int kind = Random_edit::drag; kind <= Random_edit::redo; ++kind)
    BOOST_TEST(is_enough(done[kind], 100));
}

// A stroke of which something was done while nothing was kept is not kept at all: undo would take back a part of it.
BOOST_AUTO_TEST_CASE(a_stroke_begun_while_the_history_is_off) {
  for (const bool changes_before : {true, false}) {
    Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.3, 0.05));
    Sculptor<Mesh> sculptor(mesh);
    const Mesh_snapshot begin = snapshot(sculptor);
    const auto drag = [&](std::size_t v) {
      BOOST_TEST(sculptor.grab(Vertex_index(v)).drag_to(moved_by(mesh, Vertex_index(v), 0.01)).reached);
    };
    sculptor.set_history_limit({0, 0});
    {
      const auto stroke = sculptor.stroke();
      if (changes_before)
        drag(3);
      sculptor.set_history_limit({});
      drag(50);
      BOOST_REQUIRE(static_cast<bool>(
          sculptor.insert_on_face(Mesh::Face_index(7), in_face(mesh, Mesh::Face_index(7), 0.3, 0.3))));
    }
    const Mesh_snapshot end = snapshot(sculptor);
    BOOST_TEST(sculptor.history().number_of_undo_steps() == (changes_before ? 0u : 1u));
    BOOST_TEST(static_cast<bool>(sculptor.undo()) == !changes_before);
    BOOST_TEST((snapshot(sculptor) == (changes_before ? end : begin)));
    drag(60); // what follows is kept
    BOOST_TEST(static_cast<bool>(sculptor.undo()));
    BOOST_TEST((snapshot(sculptor) == (changes_before ? end : begin)));
  }
}
