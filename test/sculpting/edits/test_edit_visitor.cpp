// SPDX-License-Identifier: GPL-3.0-or-later
// What the visitor hears suffices to keep a copy of the mesh, and it hears nothing of what did not happen.
#include "sculpting/edits/Mirror_visitor.h"
#include "sculpting/edits/random_edits.h"

#include <boost/test/unit_test.hpp>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

using Visited_sculptor = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Mirror_visitor>;

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
