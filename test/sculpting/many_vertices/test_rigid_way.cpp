// SPDX-License-Identifier: GPL-3.0-or-later
// Which matrices are taken for a rigid motion.
#include "sculpting/Mesh_snapshot.h"
#include "sculpting/many_vertices/many_vertices_scene.h"

#include <haptic_sculpt/sculpting/move_rigidly.h>

#include <boost/test/unit_test.hpp>

#include <seeds_and_sizes.h>

#include <cmath>
#include <random>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

BOOST_AUTO_TEST_CASE(what_is_no_rigid_motion_is_refused) {
  Mesh mesh = meshes::to_mesh(meshes::cube());
  Sculptor<Mesh> sculptor(mesh);
  const Mesh_snapshot before = snapshot(sculptor);
  const auto all = mesh.vertices();
  const double half = std::sqrt(0.5);
  for (const Transformation& t :
       {Transformation(CGAL::SCALING, 2), Transformation(1 + 1e-9, 0, 0, 0, 1, 0, 0, 0, 1),
        Transformation(-1, 0, 0, 0, 1, 0, 0, 0, 1), Transformation(-1, 0, 0, 0, -1, 0, 0, 0, 1), // half a turn
        Transformation(half, -half, 0, 0, half, half, 0, 0, 0, 0, 1, 1),                         // a screw
        Transformation(std::nan(""), 0, 0, 0, 1, 0, 0, 0, 1)})
    BOOST_CHECK_THROW(move_rigidly(sculptor, all, t), Invalid_parameter);
  BOOST_CHECK_THROW(move_rigidly(sculptor, all, translation(Vector_3(0x1p1001, 0, 0))), Out_of_range);
  BOOST_CHECK_THROW(move_rigidly(sculptor, all, translation(Vector_3(std::nan(""), 0, 0))), Out_of_range);
  BOOST_CHECK_THROW(move_rigidly(sculptor, std::vector<Vertex_index>{Vertex_index(99)}, translation(Vector_3(1, 0, 0))),
                    Unknown_vertex);
  BOOST_TEST((snapshot(sculptor) == before));
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 0u);
  const auto none = move_rigidly(sculptor, std::vector<Vertex_index>(), translation(Vector_3(1, 0, 0)));
  BOOST_TEST(none.share == 1);
  BOOST_TEST(none.asked == 0u);
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 0u);
}

// About an axis through the origin, and near it, nothing but rounding is left of the shift.
BOOST_AUTO_TEST_CASE(a_rotation_composed_of_rounded_factors_is_one) {
  std::mt19937_64 random(seed_from_environment(8));
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int k = 0; k < 100; ++k) {
    Mesh mesh = meshes::to_mesh(meshes::cube());
    Sculptor<Mesh> sculptor(mesh);
    const Vector_3 way(uniform(random), uniform(random), uniform(random));
    const Vector_3 u = way / std::sqrt(way.squared_length()), off(k % 2 * 1e-3, 0, 0);
    const double angle = 1.6 + 1.4 * uniform(random), c = std::cos(angle), s = std::sin(angle), d = 1 - c;
    const Transformation turn(c + d * u.x() * u.x(), d * u.x() * u.y() - s * u.z(), d * u.x() * u.z() + s * u.y(),
                              d * u.x() * u.y() + s * u.z(), c + d * u.y() * u.y(), d * u.y() * u.z() - s * u.x(),
                              d * u.x() * u.z() - s * u.y(), d * u.y() * u.z() + s * u.x(), c + d * u.z() * u.z());
    const Vector_3 centre = std::exp2(k % 8) * u + off;
    const auto report = move_rigidly(sculptor, mesh.vertices(), translation(centre) * turn * translation(-centre));
    BOOST_TEST(report.share == 1);
    BOOST_CHECK_THROW(
        move_rigidly(sculptor, mesh.vertices(), translation(centre + 1e-6 * u) * turn * translation(-centre)),
        Invalid_parameter);
  }
}
