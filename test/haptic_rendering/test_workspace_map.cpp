// SPDX-License-Identifier: GPL-3.0-or-later
#include "haptic_rendering/random_vector.h"

#include <haptic_sculpt/haptic_rendering/Workspace_map.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace haptic_sculpt;
using namespace haptic_rendering_tests;

namespace {

BOOST_AUTO_TEST_CASE(a_map_there_and_back_is_the_identity) {
  Random random(haptic_sculpt::test::seed_from_environment(1));
  for (int i = 0; i < 1000; ++i) {
    const Workspace_map map(std::exp(5 * random_vector(random)[0]), random_vector(random, 3), random_vector(random, 10),
                            random_vector(random, 0.1));
    const Vector3d p = random_vector(random, 0.1), q = map.to_scene(p);
    BOOST_TEST((map.to_device(q) - p).norm() <= 1e-15 * (1 + q.norm() / map.scale()) * 20);
    // The rotation against Rodrigues' formula.
    const Vector3d w = map.rotation_vector(), axis = w.normalized(), x = random_vector(random);
    const Vector3d turned =
        x * std::cos(w.norm()) + axis.cross(x) * std::sin(w.norm()) + axis * axis.dot(x) * (1 - std::cos(w.norm()));
    BOOST_TEST((map.to_scene(map.home() + x) - map.origin() - map.scale() * turned).norm() <=
               1e-13 * map.scale() * (1 + x.norm()) + 1e-14 * (map.origin().norm() + map.scale() * map.home().norm()));
    BOOST_TEST((map.way_to_device(map.scale() * turned) - x).norm() <= 1e-13 * (1 + x.norm()));
  }
  BOOST_CHECK_THROW(Workspace_map(0, Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()), Error);
  BOOST_CHECK_THROW(Workspace_map(1, Vector3d::Constant(NAN), Vector3d::Zero(), Vector3d::Zero()), Error);
  BOOST_CHECK_THROW(Workspace_map(1, Vector3d(1e200, 0, 0), Vector3d::Zero(), Vector3d::Zero()), Error); // rad
}

BOOST_AUTO_TEST_CASE(the_fitted_map_puts_the_corners_of_the_box_on_the_ball) {
  const Vector3d lower(-3, 1, 2), upper(5, 2, 9), home(0, 0, 0.13);
  const Workspace_map map = Workspace_map::fitted(lower, upper, home, 0.034);
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d p(corner & 1 ? lower[0] : upper[0], corner & 2 ? lower[1] : upper[1],
                     corner & 4 ? lower[2] : upper[2]);
    BOOST_TEST(std::abs((map.to_device(p) - home).norm() - 0.034) <= 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(a_map_that_is_pinned_leads_one_place_to_another_and_keeps_its_rotation) {
  Random random(haptic_sculpt::test::seed_from_environment(62));
  for (int i = 0; i < 100; ++i) {
    const Vector3d rotation = random_vector(random, 2), home = random_vector(random, 0.1);
    const Workspace_map map(40, rotation, random_vector(random, 3), home);
    const Vector3d device = random_vector(random, 0.1), scene = random_vector(random, 5), x = random_vector(random, 1);
    const Workspace_map pinned = map.pinned(device, scene, 55);
    BOOST_TEST((pinned.to_scene(device) - scene).norm() <= 1e-12);
    BOOST_TEST((pinned.scale() == 55 && pinned.home() == home && pinned.rotation_vector() == rotation));
    // Rodrigues' formula.
    const double angle = rotation.norm();
    const Vector3d axis = rotation / angle,
                   turned = std::cos(angle) * x + std::sin(angle) * axis.cross(x) +
                            (1 - std::cos(angle)) * axis.dot(x) * axis;
    BOOST_TEST((map.rotation() * x - turned).norm() <= 1e-12);
    BOOST_TEST((pinned.rotation() * x - turned).norm() <= 1e-12);
    BOOST_CHECK_THROW(map.pinned(device, scene, 0), Error);
  }
}

} // namespace
