// SPDX-License-Identifier: GPL-3.0-or-later
// A clearance that the scene has outgrown since it was given.
#include "sculpting/many_vertices/many_vertices_scene.h"

#include <haptic_sculpt/sculpting/brushes.h>
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
  // Nor where the targets are far.
  const Point_3 far = mesh.point(other[0]);
  const Dab_3<meshes::Kernel> dab{Brush_kind::grab, far, 4, 0.25, Vector_3(1, 0, 0)};
  BOOST_TEST(apply_brush(sculptor, std::vector<Dab_3<meshes::Kernel>>{dab}).reached > 0u);
  BOOST_CHECK_THROW(apply_brush(sculptor, std::vector<Dab_3<meshes::Kernel>>{dab},
                                boost::static_property_map<double, Vertex_index>(1.0), Move_parameters()),
                    Invalid_parameter);
}

// What is set has been checked when it was set: it is refused where the scene outgrows it, not where that shrinks,
// whoever asked what in between, so that a log which sets it is made again.
BOOST_AUTO_TEST_CASE(a_clearance_that_is_set_serves_as_one_that_was_given_does) {
  const double clearance = 0x1p-5; // of an extent of 4 the most; of 2 twice as much
  for (const bool is_given : {true, false})
    for (const int question :
         {0, 1, 2}) { // before the scene shrinks: none, a probe, a drag with a clearance of its own
      Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
      const Point_3 corners[] = {{0, 0, 0}, {4, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      for (std::size_t k = 0; k < 4; ++k)
        mesh.point(Vertex_index(static_cast<unsigned>(k))) = corners[k];
      Sculptor<Mesh> sculptor(mesh,
                              is_given ? Sculptor_parameters(parameters::clearance(clearance)) : Sculptor_parameters());
      if (!is_given)
        sculptor.set_drag_parameters(Drag_parameters().clearance(clearance));
      if (question == 1)
        sculptor.probe(Point_3(9, 9, 9)).drag_to(Point_3(9, 9, 8));
      if (question == 2)
        sculptor.drag(Vertex_index(0), Point_3(-0.1, 0, 0), Drag_parameters().clearance(0x1p-9));
      BOOST_TEST(bool(sculptor.shift(0, {{Vertex_index(1), 2.0}})));
      sculptor.set_delta(0x1p-10);
      BOOST_TEST((sculptor.drag(Vertex_index(0), Point_3(-0.2, 0, 0)).end == Drag_end::reached));
      BOOST_CHECK_THROW(sculptor.set_drag_parameters(Drag_parameters().clearance(0x1p-4)), Invalid_parameter);
    }
}
