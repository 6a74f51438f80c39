// SPDX-License-Identifier: GPL-3.0-or-later
// What the visitor hears suffices to keep a copy of the mesh, and it hears nothing of what did not happen.
#include "sculpting/edits/Mirror_visitor.h"
#include "sculpting/edits/random_edits.h"

#include <CGAL/boost/graph/copy_face_graph.h>

#include <boost/test/unit_test.hpp>

#include <functional>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

using Visited_sculptor = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Mirror_visitor>;

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

} // namespace

// In each call of each kind of edit, undone and redone as well. The edit is not made, or stands, and the Sculptor goes
// on.
BOOST_AUTO_TEST_CASE(an_exception_of_the_visitor) {
  using Throwing_sculptor = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Throwing_visitor>;
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
  using Throwing_sculptor = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Throwing_visitor>;
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

namespace {

/// Tetrahedra one over the other: a point of each, the first below, may be drawn up or down.
Mesh tower() {
  meshes::Triangle_list list = meshes::tetrahedron();
  for (const double z : {2., 4., 6.}) {
    meshes::Triangle_list next = meshes::tetrahedron();
    list += next.scale_and_move(1, 0, 0, z);
  }
  return meshes::to_mesh(list);
}

/// Asks in the midst of changes, and throws.
struct Asking_visitor : Default_edit_visitor {
  std::function<void()> ask;
  void vertex_moved(Vertex_index) { hear(); }
  void face_dies(Mesh::Face_index) { hear(); }
  void face_created(Mesh::Face_index) { hear(); }

private:
  void hear() {
    if (ask)
      ask();
  }
};

using Asked_sculptor = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Asking_visitor>;

Vertex_index top_of(const Mesh& mesh, double z) {
  for (const Vertex_index v : mesh.vertices())
    if (mesh.point(v).z() == z)
      return v;
  return Vertex_index();
}

} // namespace

// A stroke that goes over itself: two of its moves, taken alone, would cross.
BOOST_AUTO_TEST_CASE(an_undo_that_a_visitor_breaks_off_leaves_no_crossing) {
  for (std::size_t call = 1; call <= 3; ++call) {
    meshes::Triangle_list list = meshes::tetrahedron(), facing = meshes::tetrahedron();
    facing.transform([](const meshes::Point_3& p) { return meshes::Point_3(p.x(), p.y(), 10 - 8 * p.z()); });
    list += facing.turn_inside_out();
    Mesh mesh = meshes::to_mesh(list);
    Asked_sculptor sculptor(mesh);
    const Vertex_index low = top_of(mesh, 1), high = top_of(mesh, 2);
    const auto draw = [&](Vertex_index v, double z) { BOOST_REQUIRE(sculptor.drag(v, {0, 0, z}).reached); };
    {
      const auto stroke = sculptor.stroke();
      draw(low, 1.5);
      draw(high, 9);
      draw(low, 8); // is one move with the first
    }
    std::size_t left = call;
    sculptor.visitor().ask = [&left] {
      if (--left == 0)
        throw Thrown{false};
    };
    try {
      sculptor.undo();
    } catch (const Thrown&) {
    }
    sculptor.visitor().ask = nullptr;
    BOOST_TEST(validate(mesh).is_valid());
    const double heights[2][2] = {{8, 9}, {1, 2}};
    const bool is_back = call > 1; // the exception came when the last was back
    BOOST_TEST(mesh.point(low).z() == heights[is_back][0]);
    BOOST_TEST(mesh.point(high).z() == heights[is_back][1]);
  }
}

// What is asked for within an undo is not used when it is over.
BOOST_AUTO_TEST_CASE(questions_within_an_undo_spoil_no_later_drag) {
  std::size_t asked = 0;
  for (std::size_t call = 1; call <= 4; ++call) {
    Mesh mesh = tower();
    Asked_sculptor sculptor(mesh);
    std::vector<Vertex_index> vertices(mesh.vertices().begin(), mesh.vertices().begin() + 4);
    {
      const auto stroke = sculptor.stroke();
      for (std::size_t k = 0; k + 1 < vertices.size(); ++k)
        sculptor.drag(vertices[k], mesh.point(vertices[k]) + meshes::Kernel::Vector_3(-0.3, -0.2, -0.3));
    }
    std::size_t left = call;
    sculptor.visitor().ask = [&] {
      if (--left == 0) {
        ++asked;
        for (const Vertex_index v : vertices) {
          sculptor.first_impact(v, mesh.point(v) + meshes::Kernel::Vector_3(0, 0, 2));
          sculptor.is_inside_out(v);
        }
      }
    };
    sculptor.undo();
    sculptor.visitor().ask = nullptr;
    Mesh copy = mesh;
    Sculptor<Mesh> fresh(copy);
    for (const Vertex_index v : {vertices[3], vertices[0]}) {
      const Mesh::Point target = mesh.point(v) + meshes::Kernel::Vector_3(0.01, 0.02, 3);
      const auto made = sculptor.drag(v, target), expected = fresh.drag(v, target);
      BOOST_TEST((made.position == expected.position && made.reached == expected.reached));
    }
    BOOST_TEST(validate(mesh).is_valid());
  }
  BOOST_TEST(asked >= 3u);
}

BOOST_AUTO_TEST_CASE(a_vertex_created_is_asked_about_anew) {
  Mesh mesh = tower();
  meshes::Triangle_list turned = meshes::tetrahedron();
  CGAL::copy_face_graph(meshes::to_mesh(turned.turn_inside_out().scale_and_move(1, 20, 0, 0)), mesh);
  Asked_sculptor sculptor(mesh);
  const Mesh::Face_index f(static_cast<Mesh::size_type>(mesh.num_faces() - 1));
  sculptor.visitor().ask = [&] { sculptor.is_inside_out(*mesh.vertices().begin()); };
  const auto made = sculptor.insert_on_face(f, in_face(mesh, f, 0.3, 0.3));
  sculptor.visitor().ask = nullptr;
  BOOST_REQUIRE(static_cast<bool>(made));
  BOOST_TEST(sculptor.is_inside_out(*made.vertex));
  BOOST_TEST(!sculptor.is_inside_out(*mesh.vertices().begin()));
}

BOOST_AUTO_TEST_CASE(a_mirror_kept_by_the_visitor_equals_the_mesh) {
  Random random(seed_from_environment(34));
  const std::size_t edits = count_from_environment("HAPTIC_SCULPT_VISITED_EDITS", 10000);
  std::map<int, std::size_t> done;
  std::size_t refused = 0, different = 0, wrongly_told = 0, not_told = 0;
  for (std::size_t batch = 0; batch * 2500 < edits; ++batch) {
    meshes::Triangle_list list =
        batch % 2 == 0 ? meshes::bumpy_sphere(1, 0.3, 0.05, static_cast<std::uint32_t>(batch)) : meshes::torus(7, 5);
    list += meshes::icosphere(0).scale_and_move(0.4, 2, 0, 0);
    Mesh mesh = meshes::to_mesh(list);
    Visited_sculptor sculptor(mesh, {}, Mirror_visitor(mesh));
    const Mirror_visitor& mirror = sculptor.visitor();
    const auto compare = [&] { different += mirror.snapshot() != snapshot(sculptor) || !mirror.has_edges_of_mesh(); };
    for (int i = 0; i < 2500; ++i) {
      const std::size_t calls = mirror.calls;
      const Random_edit edit = random_edit(sculptor, random);
      if (edit.is_done) {
        ++done[edit.kind];
        not_told += mirror.calls == calls;
      } else {
        ++refused;
        wrongly_told += mirror.calls != calls;
      }
      if (i % 10 == 9)
        compare();
    }
    while (sculptor.undo())
      ;
    compare();
    while (sculptor.redo())
      ;
    compare();
    BOOST_TEST(mirror.faults == 0u);
  }
  BOOST_TEST_MESSAGE(refused << " refused or without a move");
  BOOST_TEST(different == 0u);
  BOOST_TEST(not_told == 0u);
  BOOST_TEST(wrongly_told == 0u);
  for (const int kind :
       {Random_edit::drag, Random_edit::insert_on_face, Random_edit::insert_on_edge, Random_edit::remove,
        Random_edit::collapse, Random_edit::flip, Random_edit::undo, Random_edit::redo})
    BOOST_TEST(is_enough(done[kind], 50));
}

BOOST_AUTO_TEST_CASE(counts_of_what_dies_and_is_created) {
  struct Counts : Default_edit_visitor {
    std::array<int, 7> n{}; // moved; vertices, edges, faces dead; created
    void vertex_moved(Vertex_index) { ++n[0]; }
    void vertex_dies(Vertex_index, std::size_t) { ++n[1]; }
    void edge_dies(Mesh::Edge_index) { ++n[2]; }
    void face_dies(Mesh::Face_index) { ++n[3]; }
    void vertex_created(Vertex_index, std::size_t) { ++n[4]; }
    void edge_created(Mesh::Edge_index) { ++n[5]; }
    void face_created(Mesh::Face_index) { ++n[6]; }
  };
  using Numbers = std::array<int, 7>;
  Mesh mesh = meshes::to_mesh(meshes::icosphere(0));
  Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Counts> sculptor(mesh);
  const auto told = [&] { return std::exchange(sculptor.visitor().n, Numbers{}); };
  const auto f = *mesh.faces().begin();
  const auto v = *sculptor.insert_on_face(f, in_face(mesh, f, 0.3, 0.3)).vertex;
  BOOST_TEST((told() == Numbers{0, 0, 0, 1, 1, 3, 3}));
  sculptor.undo();
  BOOST_TEST((told() == Numbers{0, 1, 3, 3, 0, 0, 1}));
  sculptor.redo();
  BOOST_TEST((told() == Numbers{0, 0, 0, 1, 1, 3, 3}));
  sculptor.remove(v);
  BOOST_TEST((told() == Numbers{0, 1, 3, 3, 0, 0, 1}));
  const auto e = *mesh.edges().begin();
  BOOST_TEST(static_cast<bool>(
      sculptor.insert_on_edge(e, CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))))));
  BOOST_TEST((told() == Numbers{0, 0, 1, 2, 1, 4, 4}));
  sculptor.undo();
  BOOST_TEST((told() == Numbers{0, 1, 4, 4, 0, 1, 2}));
  BOOST_TEST(static_cast<bool>(sculptor.remove(Vertex_index(3)))); // of valence 5
  BOOST_TEST((told() == Numbers{0, 1, 5, 5, 0, 2, 3}));
  sculptor.undo();
  BOOST_TEST((told() == Numbers{0, 0, 2, 3, 1, 5, 5}));
  BOOST_TEST(
      static_cast<bool>(sculptor.collapse(mesh.halfedge(Vertex_index(3))))); // what it points away from has valence 5
  BOOST_TEST((told() == Numbers{0, 1, 5, 5, 0, 2, 3}));
  sculptor.undo();
  BOOST_TEST((told() == Numbers{0, 0, 2, 3, 1, 5, 5}));
  BOOST_TEST(static_cast<bool>(sculptor.flip(*mesh.edges().begin())));
  BOOST_TEST((told() == Numbers{0, 0, 1, 2, 0, 1, 2}));
  sculptor.undo();
  BOOST_TEST((told() == Numbers{0, 0, 1, 2, 0, 1, 2}));
  sculptor.grab(Vertex_index(0)).drag_to(mesh.point(Vertex_index(0)) + meshes::Kernel::Vector_3(0, 0.1, 0));
  BOOST_TEST((told() == Numbers{1, 0, 0, 0, 0, 0, 0}));
  sculptor.undo();
  BOOST_TEST((told() == Numbers{1, 0, 0, 0, 0, 0, 0}));
  sculptor.grab(Vertex_index(0)).drag_to(mesh.point(Vertex_index(0)));
  sculptor.probe({5, 0, 0}).drag_to({4, 0, 0});
  sculptor.insert_on_face(*mesh.faces().begin(), mesh.point(Vertex_index(0)));
  BOOST_TEST((told() == Numbers{}));
}
