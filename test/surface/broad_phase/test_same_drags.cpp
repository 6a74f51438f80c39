// SPDX-License-Identifier: GPL-3.0-or-later
// What a sculptor does, to the bit, with each broad phase.
#include "surface/broad_phase/random_points.h"
#include "surface/broad_phase/swept_faces.h"

#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/sculpting/paper_1997/Six_list_broad_phase.h>
#include <haptic_sculpt/surface/broad_phase/Box_tree_broad_phase.h>

#include <boost/test/unit_test.hpp>

#include <cstring>

using namespace haptic_sculpt;
using namespace broad_phase_tests;

namespace {

/// What a script of drags does, to the last bit.
template <template <class> class Model>
std::vector<double> trace_of(Mesh mesh, std::uint64_t seed_of_script) {
  Random random(seed_of_script);
  std::vector<double> trace;
  Sculptor<Mesh, Model<Mesh>> sculptor(mesh);
  for (int k = 0; k < 120; ++k) {
    const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
    auto grab = sculptor.grab(v);
    for (int step = 0; step < 4; ++step) {
      const Coordinates p = vertex_coordinates(mesh, v), d = random_point(random, random() % 3 == 0 ? 3 : 0.2);
      const auto result =
          random() % 8 == 0
              ? grab.drag_to(mesh.point(Vertex_index(static_cast<Mesh::size_type>(random() % mesh.num_vertices()))))
              : grab.drag_to(Point_3(p[0] + d[0], p[1] + d[1], p[2] + d[2]));
      trace.insert(trace.end(), {result.position.x(), result.position.y(), result.position.z(), result.stop_error,
                                 result.stop_error_along_path, result.kkt_residual, double(result.legs),
                                 double(static_cast<int>(result.end)), double(result.contacts.size())});
      for (const auto& contact : result.contacts) {
        trace.insert(trace.end(), contact.normal.cartesian_begin(), contact.normal.cartesian_end());
        trace.push_back(static_cast<int>(contact.kind));
        for (const Vertex_index w : contact.vertices)
          trace.push_back(static_cast<double>(static_cast<std::uint32_t>(w)));
      }
    }
  }
  for (const Vertex_index v : mesh.vertices())
    for (const double x : vertex_coordinates(mesh, v))
      trace.push_back(x);
  return trace;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

} // namespace

BOOST_AUTO_TEST_CASE(no_result_of_a_sculptor_depends_on_the_broad_phase) {
  const std::uint64_t first = seed();
  std::size_t script = 0;
  for (const Mesh& scene : {meshes::to_mesh(meshes::icosphere(2)), meshes::to_mesh(meshes::box(4)),
                            meshes::to_mesh(meshes::torus(16, 9)), meshes::to_mesh(meshes::row_of_spheres(3))}) {
    const std::vector<double> expected = trace_of<Brute_force_broad_phase>(scene, first + script);
    BOOST_TEST(same_bits(trace_of<Six_list_broad_phase>(scene, first + script), expected));
    BOOST_TEST(same_bits(trace_of<Box_tree_broad_phase>(scene, first + script), expected));
    ++script;
  }
}
