// SPDX-License-Identifier: GPL-3.0-or-later
// How fast the handle is: by its Jacobian, and behind low-passes.
#include "haptic_rendering/devices_of_tests.h"

#include <haptic_sculpt/haptic_rendering/Acceleration_estimate.h>
#include <haptic_sculpt/haptic_rendering/Handle_motion.h>
#include <haptic_sculpt/haptic_rendering/Velocity_estimate.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <Eigen/SVD>

#include <cmath>

using namespace haptic_sculpt;
using namespace haptic_rendering_tests;

namespace {

BOOST_AUTO_TEST_CASE(a_damper_behind_its_low_pass_changes_by_no_more_than_is_said_for_a_step) {
  for (const double tick : {0.00025, 0.001, 0.004}) {
    Velocity_estimate velocity(tick);
    const double step = 1e-4, damping = 2;
    const double change = damping * velocity.add(Vector3d(step, 0, 0)).norm();
    BOOST_TEST(change <= Velocity_estimate::change_of_way(damping) * step);
    if (tick < 0.0005)
      BOOST_TEST(change >= 0.9 * Velocity_estimate::change_of_way(damping) * step);
    BOOST_TEST((velocity.value() - Vector3d(change / damping, 0, 0)).norm() <= 1e-12);
    velocity.reset();
    BOOST_TEST(velocity.value() == Vector3d::Zero());
    Acceleration_estimate acceleration(tick);
    acceleration.add(Vector3d(step, 0, 0)), acceleration.add(Vector3d(3 * step, 0, 0));
    BOOST_TEST(acceleration.value()[0] > 0);
    acceleration.reset();
    BOOST_TEST(acceleration.value() == Vector3d::Zero());
    BOOST_TEST(acceleration.add(Vector3d(step, 0, 0)) == Vector3d::Zero()); // no second difference yet
  }
}

BOOST_AUTO_TEST_CASE(a_handle_is_as_fast_as_its_jacobian_and_steps_begin_after_the_first_angles) {
  Random random(haptic_sculpt::test::seed_from_environment(64));
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_parameters<double> parameters = device(form);
    Handle_motion handle(parameters, *home_pose(parameters), 0.001);
    BOOST_TEST((!handle.has_step() && handle.greatest() == 0));
    BOOST_TEST((handle.jacobian().linear.isZero(0) && handle.jacobian().angular.isZero(0)));
    for (int i = 0; i < 20; ++i) {
      handle.follow(home_pose(parameters)->theta + random_vector(random, 0.2), 0.001);
      BOOST_TEST(handle.has_step() == (i > 0));
      const Eigen::JacobiSVD<Eigen::Matrix3d> svd(handle.jacobian().linear);
      BOOST_TEST(std::abs(handle.greatest() / svd.singularValues()[0] - 1) <= 1e-9);
    }
    handle.restart();
    handle.follow(home_pose(parameters)->theta, 0.001);
    BOOST_TEST(!handle.has_step());
  }
}

} // namespace
