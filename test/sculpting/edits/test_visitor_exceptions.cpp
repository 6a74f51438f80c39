// SPDX-License-Identifier: GPL-3.0-or-later
// What a visitor throws: the edit is not made, or stands, and a step of undo is made whole or not at all.
#include "sculpting/Mesh_snapshot.h"
#include "sculpting/edits/random_edits.h"

#include <boost/test/unit_test.hpp>

#include <functional>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

struct Thrown {
  bool is_before; ///< while the mesh is still as it was
};

/// Counts calls down, and throws at the last.
struct Throwing_visitor : Default_edit_visitor {
  std::size_t calls_left = ~std::size_t{0}, again = 0; ///< where not 0: it throws once more after this many calls

  void vertex_moved(Vertex_index) { call(false); }
  void vertex_dies(Vertex_index, std::size_t) { call(true); }
  void edge_dies(Mesh::Edge_index) { call(true); }
  void face_dies(Mesh::Face_index) { call(true); }
  void vertex_created(Vertex_index, std::size_t) { call(false); }
  void edge_created(Mesh::Edge_index) { call(false); }
  void face_created(Mesh::Face_index) { call(false); }

private:
  void call(bool is_before) {
    if (--calls_left != 0)
      return;
    calls_left = again != 0 ? again : ~std::size_t{0};
    throw Thrown{is_before};
  }
};

using Throwing_sculptor = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Throwing_visitor>;

Vertex_index top_of(const Mesh& mesh, double z) {
  for (const Vertex_index v : mesh.vertices())
    if (mesh.point(v).z() == z)
      return v;
  return Vertex_index();
}

} // namespace

// In each call of each kind of edit, undone and redone as well. The edit is not made, or stands, and the Sculptor goes
// on.
BOOST_AUTO_TEST_CASE(an_exception_of_the_visitor) {
  Random random(seed_from_environment(36));
  const meshes::Triangle_list list = meshes::bumpy_sphere(1, 0.3, 0.05);
  const std::vector<std::function<void(Throwing_sculptor&)>> edits = {
      [](auto& s) {
        s.grab(Vertex_index(4)).drag_to(s.mesh().point(Vertex_index(4)) + meshes::Kernel::Vector_3(0.01, 0.02, 0));
      },
      [](auto& s) { s.insert_on_face(Mesh::Face_index(5), in_face(s.mesh(), Mesh::Face_index(5), 0.3, 0.3)); },
      [](auto& s) {
        s.insert_on_edge(Mesh::Edge_index(5), CGAL::midpoint(s.mesh().point(s.mesh().vertex(Mesh::Edge_index(5), 0)),
                                                             s.mesh().point(s.mesh().vertex(Mesh::Edge_index(5), 1))));
      },
      [](auto& s) { s.remove(Vertex_index(13)); },
      [](auto& s) { s.collapse(s.mesh().halfedge(Vertex_index(3))); },
      [](auto& s) { s.flip(s.mesh().edge(s.mesh().halfedge(Vertex_index(9)))); }};
  std::size_t before_it = 0, after_it = 0;
  for (std::size_t kind = 0; kind < edits.size(); ++kind)
    for (const int way : {0, 1, 2}) { // made, undone, redone
      Mesh_snapshot made;
      bool has_thrown = true;
      for (std::size_t call = 0; has_thrown; ++call) { // 0: without an exception
        Mesh mesh = meshes::to_mesh(list);
        Throwing_sculptor sculptor(mesh);
        const Mesh_snapshot begin = snapshot(sculptor);
        sculptor.grab(Vertex_index(8)).drag_to(mesh.point(Vertex_index(8)) + meshes::Kernel::Vector_3(0.01, 0, 0));
        const Mesh_snapshot moved = snapshot(sculptor);
        if (way != 0)
          edits[kind](sculptor);
        if (way == 2)
          sculptor.undo();
        if (call == 0) {
          way == 0 ? edits[kind](sculptor) : void(way == 2 && sculptor.redo());
          made = snapshot(sculptor);
          BOOST_REQUIRE((made != moved));
          continue;
        }
        BOOST_REQUIRE((snapshot(sculptor) == (way == 1 ? made : moved)));
        sculptor.visitor().calls_left = call;
        has_thrown = false;
        bool is_before = false;
        try {
          way == 0 ? edits[kind](sculptor) : void(way == 1 ? sculptor.undo() : sculptor.redo());
        } catch (const Thrown& thrown) {
          has_thrown = true;
          is_before = thrown.is_before;
          ++(is_before ? before_it : after_it);
        }
        sculptor.visitor().calls_left = ~std::size_t{0};
        sculptor.check_unchanged();
        const bool is_made = (way == 1) == is_before;
        BOOST_TEST((snapshot(sculptor) == (is_made ? made : moved)));
        BOOST_TEST(mesh.is_valid(false));
        BOOST_TEST(sculptor.history().number_of_undo_steps() == (is_made ? 2u : 1u));
        for (int i = 0; i < 20; ++i)
          random_edit(sculptor, random);
        BOOST_TEST(validate(mesh).is_valid());
        sculptor.check_unchanged();
        while (sculptor.undo())
          ;
        BOOST_TEST((snapshot(sculptor) == begin));
      }
    }
  BOOST_TEST_MESSAGE(before_it << " exceptions before the change, " << after_it << " after it");
  BOOST_TEST(is_enough(before_it, 60));
  BOOST_TEST(is_enough(after_it, 60));
}

// The undo or redo of a stroke that is broken off in any call is made whole or not at all, also where the visitor
// throws again while it is made undone.
BOOST_AUTO_TEST_CASE(an_exception_of_the_visitor_within_a_stroke) {
  std::size_t as_it_was = 0, whole = 0;
  for (const bool is_redo : {false, true})
    for (const std::size_t again : {std::size_t{0}, std::size_t{1}, std::size_t{4}}) {
      bool has_thrown = true;
      for (std::size_t call = 1; has_thrown; ++call) {
        Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(1, 0.3, 0.05));
        Throwing_sculptor sculptor(mesh);
        const Mesh_snapshot begin = snapshot(sculptor);
        const auto drag = [&](std::size_t v) {
          sculptor.grab(Vertex_index(v))
              .drag_to(mesh.point(Vertex_index(v)) + meshes::Kernel::Vector_3(0.001, 0.002, 0));
        };
        {
          const auto stroke = sculptor.stroke();
          drag(4);
          drag(5);
          BOOST_REQUIRE(static_cast<bool>(sculptor.flip(mesh.edge(mesh.halfedge(Vertex_index(9))))));
          drag(4);
          BOOST_REQUIRE(static_cast<bool>(
              sculptor.insert_on_face(Mesh::Face_index(5), in_face(mesh, Mesh::Face_index(5), 0.3, 0.3))));
          BOOST_REQUIRE(static_cast<bool>(sculptor.remove(Vertex_index(13))));
        }
        const Mesh_snapshot made = snapshot(sculptor);
        if (is_redo)
          sculptor.undo();
        const Mesh_snapshot before = snapshot(sculptor), after = is_redo ? made : begin;
        sculptor.visitor().calls_left = call, sculptor.visitor().again = again;
        has_thrown = false;
        try {
          is_redo ? sculptor.redo() : sculptor.undo();
        } catch (const Thrown&) {
          has_thrown = true;
        }
        sculptor.visitor().calls_left = ~std::size_t{0}, sculptor.visitor().again = 0;
        sculptor.check_unchanged();
        const bool is_whole = snapshot(sculptor) == after;
        BOOST_TEST((is_whole || snapshot(sculptor) == before));
        BOOST_TEST(sculptor.history().number_of_undo_steps() == (is_whole == is_redo ? 1u : 0u));
        ++(is_whole ? whole : as_it_was);
        drag(8);
        BOOST_TEST(sculptor.history().number_of_redo_steps() == 0u);
        while (sculptor.undo())
          ;
        BOOST_TEST((snapshot(sculptor) == begin));
        sculptor.check_unchanged();
      }
    }
  BOOST_TEST_MESSAGE(as_it_was << " strokes as they were, " << whole << " whole");
  BOOST_TEST(is_enough(as_it_was, 100));
  BOOST_TEST(is_enough(whole, 6));
}

// A stroke that goes over itself: two of its moves, taken alone, would cross.
BOOST_AUTO_TEST_CASE(an_undo_that_a_visitor_breaks_off_leaves_no_crossing) {
  for (std::size_t call = 1; call <= 3; ++call) {
    meshes::Triangle_list list = meshes::tetrahedron(), facing = meshes::tetrahedron();
    facing.transform([](const meshes::Point_3& p) { return meshes::Point_3(p.x(), p.y(), 10 - 8 * p.z()); });
    list += facing.turn_inside_out();
    Mesh mesh = meshes::to_mesh(list);
    Throwing_sculptor sculptor(mesh);
    const Vertex_index low = top_of(mesh, 1), high = top_of(mesh, 2);
    const auto draw = [&](Vertex_index v, double z) { BOOST_REQUIRE(sculptor.drag(v, {0, 0, z}).reached); };
    {
      const auto stroke = sculptor.stroke();
      draw(low, 1.5);
      draw(high, 9);
      draw(low, 8); // is one move with the first
    }
    sculptor.visitor().calls_left = call;
    try {
      sculptor.undo();
    } catch (const Thrown&) {
    }
    sculptor.visitor().calls_left = ~std::size_t{0};
    BOOST_TEST(validate(mesh).is_valid());
    const double heights[2][2] = {{8, 9}, {1, 2}};
    const bool is_back = call > 1; // the exception came when the last was back
    BOOST_TEST(mesh.point(low).z() == heights[is_back][0]);
    BOOST_TEST(mesh.point(high).z() == heights[is_back][1]);
  }
}

BOOST_AUTO_TEST_CASE(a_grab_knows_where_its_vertex_is_when_a_visitor_has_thrown) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.3, 0.05));
  Throwing_sculptor sculptor(mesh);
  const Vertex_index v(20);
  auto grab = sculptor.grab(v);
  const Mesh::Point home = mesh.point(v), place = home + meshes::Kernel::Vector_3(0.01, 0, 0);
  sculptor.visitor().calls_left = 1;
  BOOST_CHECK_THROW(grab.drag_to(place), Thrown);
  BOOST_REQUIRE((mesh.point(v) == place)); // the move stands
  BOOST_REQUIRE(static_cast<bool>(sculptor.remove(v)));
  const auto stale = grab.drag_to(home);
  BOOST_TEST((stale.end == Drag_end::stale));
  BOOST_TEST((stale.position == place));
}

BOOST_AUTO_TEST_CASE(a_grab_in_a_mesh_that_was_cleared_is_refused) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.3, 0.05));
  Throwing_sculptor sculptor(mesh);
  auto grab = sculptor.grab(Vertex_index(20));
  mesh.clear();
  BOOST_CHECK_THROW(grab.drag_to({0, 0, 0}), Mesh_changed);
}
