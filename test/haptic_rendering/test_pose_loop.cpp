// SPDX-License-Identifier: GPL-3.0-or-later
#include "haptic_rendering/pose_readings.h"
#include "meshes/generated_meshes.h"

#include <haptic_sculpt/haptic_rendering.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace haptic_sculpt;
using namespace exchange_tests;
using Mesh = meshes::Mesh;

namespace {

BOOST_AUTO_TEST_CASE(a_device_of_pose_and_force_feels_a_wall_and_its_faults_end_at_no_force) {
  for (const int fault : {0, 1, 2}) {
    Mesh mesh = meshes::to_mesh(meshes::box(1, 1)); // [0, 1]^3
    const auto probe = mesh.add_vertex(Mesh::Point(0.5, 0.4, 3));
    Sculptor<Mesh> sculptor(mesh);
    Pose_loop_parameters parameters = parameters_of_tests();
    parameters.friction = 2, parameters.coupling.stiffness = 4001;
    BOOST_CHECK_THROW(Pose_loop<Sculptor<Mesh>>(sculptor, probe, map_of_tests, parameters), Error);
    parameters.coupling.stiffness = 700;
    Pose_loop<Sculptor<Mesh>> loop(sculptor, probe, map_of_tests, parameters);
    Pose_reading reading;
    const auto go = [&](double z) {
      reading.position = map_of_tests.to_device(Vector3d(0.5, 0.4, z)), reading.elapsed = 0.001;
      return loop.tick(reading);
    };
    for (int k = 0; k < 400; ++k)
      BOOST_TEST(go(1.4).force == Vector3d::Zero());
    Pose_tick tick;
    for (int k = 0; k <= 200; ++k)
      tick = go(1.4 - 0.0025 * k);
    for (int k = 0; k < 50; ++k)
      tick = go(0.9);
    BOOST_TEST((tick.force - Vector3d(0, 0, 700 * 0.1 / 50)).norm() <= 1e-9);
    reading.position[0] += fault == 0 ? NAN : fault == 1 ? 0.5 : 0, reading.elapsed = fault == 2 ? 0.1 : 0.001;
    tick = loop.tick(reading);
    BOOST_TEST((tick.fault == (fault == 0   ? Loop_fault::not_finite
                               : fault == 1 ? Loop_fault::jump
                                            : Loop_fault::stall)));
    for (int k = 0; k < 101; ++k)
      tick = go(0.9);
    BOOST_TEST(tick.force == Vector3d::Zero());
    BOOST_TEST(loop.has_stopped());
    loop.restart();
    BOOST_TEST(go(0.9).force == Vector3d::Zero()); // anchored
    BOOST_TEST(!loop.has_stopped());
  }
}

} // namespace
