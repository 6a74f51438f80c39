// SPDX-License-Identifier: GPL-3.0-or-later
// A tool in scenes of all sizes, up to the range of coordinates.
#include "haptic_rendering/Tool_bench.h"

#include <boost/test/unit_test.hpp>

#include <limits>

using namespace haptic_sculpt;
using namespace exchange_tests;

namespace {

BOOST_AUTO_TEST_CASE(scenes_of_all_sizes_leave_the_reach_as_it_was) {
  Tool_bench bench;
  const auto other = scene_of(2);
  for (const double scale : {1e-200, 1e200, 1e200, 1e-200})
    bench.tool.enter(other->sculptor, Workspace_map(scale, Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()));
  bench.tool.enter(bench.scene->sculptor, map_of_tests);
  BOOST_TEST((bench.tool.move(map_of_tests.to_device(Vector3d(0, 0, 1000)), 1).event == Tool_event::refused));
  bench.tool.move(map_of_tests.to_device(Vector3d(1.01 * bench.place(Mesh::Vertex_index(17)))), 0);
  BOOST_TEST((bench.tool.move(map_of_tests.to_device(Vector3d(1.01 * bench.place(Mesh::Vertex_index(17)))), 1).event ==
              Tool_event::grabbed));
}

BOOST_AUTO_TEST_CASE(a_probe_is_sought_within_the_range_of_coordinates) {
  meshes::Triangle_list list = meshes::bumpy_sphere(2, 0.12);
  const Mesh::Vertex_index v(static_cast<unsigned>(list.points.size()));
  list += meshes::bumpy_sphere(1, 0.12).scale_and_move(0.3, 0, 0, 0); // in the other: no probe has a place in there
  Mesh mesh = meshes::to_mesh(list.scale_and_move(0x1p998, 0, 0, 0));
  Sculptor<Mesh> sculptor(mesh);
  const Workspace_map map(std::ldexp(20, 998), Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero());
  Tool<Sculptor<Mesh>> tool(sculptor, map, 0.01, 0.001);
  const Vector3d hand = map.to_device(internal::vector_of(mesh.point(v)));
  tool.take(v);
  tool.move(hand, 0);
  tool.move(hand, 1);
  Tool_event last = Tool_event::none;
  for (int k = 0; k < 60; ++k)
    last = std::max(last, tool.move(hand, 0).event);
  BOOST_TEST((last == Tool_event::released));
}

BOOST_AUTO_TEST_CASE(a_place_beyond_the_range_of_coordinates_is_sought_within_and_never_taken) {
  Mesh mesh = meshes::to_mesh(meshes::bipyramid(4).scale_and_move(0x1p1000, 0, 0, 0));
  Sculptor<Mesh> sculptor(mesh);
  const Workspace_map map(std::ldexp(20, 998), Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero());
  Tool<Sculptor<Mesh>> tool(sculptor, map, 0.01, 0.001);
  const Vector3d hand = map.to_device(internal::vector_of(mesh.point(Mesh::Vertex_index(0))));
  tool.take(Mesh::Vertex_index(0)); // around it all places are beyond
  tool.move(hand, 0);
  tool.move(hand, 1);
  for (int k = 0; k < 60; ++k)
    tool.move(hand, 0);
  BOOST_TEST(!tool.holds_vertex());
  for (const double x : {0x1p1001, std::numeric_limits<double>::infinity()})
    BOOST_CHECK_THROW(tool.take_probe(Vector3d(x, 0, 0)), Out_of_range);
}

} // namespace
