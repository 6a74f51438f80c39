// SPDX-License-Identifier: GPL-3.0-or-later
// What the visitor hears suffices to keep a copy of the mesh, and it hears nothing of what did not happen.
#include "sculpting/edits/Mirror_visitor.h"
#include "sculpting/edits/random_edits.h"

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
  std::size_t calls_left = ~std::size_t{0};

  void vertex_moved(Vertex_index) { call(false); }
  void vertex_dies(Vertex_index, std::size_t) { call(true); }
  void edge_dies(Mesh::Edge_index) { call(true); }
  void face_dies(Mesh::Face_index) { call(true); }
  void vertex_created(Vertex_index, std::size_t) { call(false); }
  void edge_created(Mesh::Edge_index) { call(false); }
  void face_created(Mesh::Face_index) { call(false); }

private:
  void call(bool is_before) {
    if (--calls_left == 0)
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

// The undo or redo of a stroke that is broken off in any call: the next goes on with the rest of the step.
BOOST_AUTO_TEST_CASE(an_exception_of_the_visitor_within_a_stroke) {
  using Throwing_sculptor = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Throwing_visitor>;
  std::size_t thrown = 0;
  for (const bool is_redo : {false, true})
    for (const bool goes_on : {true, false}) { // or something new is done then
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
        const auto step = [&] { return static_cast<bool>(is_redo ? sculptor.redo() : sculptor.undo()); };
        if (is_redo)
          sculptor.undo();
        sculptor.visitor().calls_left = call;
        has_thrown = false;
        try {
          step();
        } catch (const Thrown&) {
          has_thrown = true;
          ++thrown;
        }
        sculptor.visitor().calls_left = ~std::size_t{0};
        sculptor.check_unchanged();
        BOOST_TEST(mesh.is_valid(false));
        if (goes_on) {
          step();
          BOOST_TEST((snapshot(sculptor) == (is_redo ? made : begin)));
          is_redo ? sculptor.undo() : sculptor.redo();
          BOOST_TEST((snapshot(sculptor) == (is_redo ? begin : made)));
        } else {
          drag(8);
          BOOST_TEST(sculptor.history().number_of_redo_steps() == 0u);
          while (sculptor.undo())
            ;
          BOOST_TEST((snapshot(sculptor) == begin));
        }
        sculptor.check_unchanged();
      }
    }
  BOOST_TEST_MESSAGE(thrown << " exceptions");
  BOOST_TEST(is_enough(thrown, 100));
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
