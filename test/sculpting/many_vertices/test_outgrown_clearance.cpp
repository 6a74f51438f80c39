// SPDX-License-Identifier: GPL-3.0-or-later
// A clearance that the scene has outgrown since it was given.
#include "sculpting/many_vertices/many_vertices_scene.h"

#include <haptic_sculpt/sculpting/move_rigidly.h>
#include <haptic_sculpt/sculpting/move_vertices.h>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

// What moves others at once does not ask for the clearance of drags.
BOOST_AUTO_TEST_CASE(a_clearance_that_the_scene_has_outgrown_is_told_before_anything_moves) {
  meshes::Triangle_list list = meshes::icosphere(2);
  const std::size_t first_of_other = list.points.size();
  list += meshes::tetrahedron().scale_and_move(1, 5, 0, 0);
  Mesh mesh = meshes::to_mesh(list);
  Sculptor<Mesh> sculptor(mesh, parameters::clearance(1e-9));
  std::vector<Vertex_index> ball, other;
  for (const Vertex_index v : mesh.vertices())
    (static_cast<std::size_t>(v) < first_of_other ? ball : other).push_back(v);
  BOOST_TEST(move_rigidly(sculptor, other, translation({0x1p24, 0, 0})).share == 1);
  const Point_map through = mesh.add_property_map<Vertex_index, Point_3>("v:target").first;
  for (const Vertex_index v : mesh.vertices())
    put(through, v, Point_3(0, 0, -mesh.point(v).z()));
  const Mesh_snapshot before = snapshot(sculptor);
  BOOST_CHECK_THROW(move_vertices(sculptor, ball, through), Invalid_parameter);
  BOOST_TEST((snapshot(sculptor) == before));
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 1u);
  BOOST_TEST(move_vertices(sculptor, ball, through, Move_parameters().drags(false)).asked == ball.size());
}
