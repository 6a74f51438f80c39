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

// D1's general form: on the straight way of the joints from one pose to the other its mode ends at a fold.
BOOST_AUTO_TEST_CASE(a_restart_finds_the_handle_where_no_straight_way_leads_from_the_last_pose) {
  const Device_parameters<double> parameters = device(Device_form::general);
  const Device_pose<double> home = *home_pose(parameters);
  const Vector3d before(-0.316, 2.212, 2.270), via(0.915, 0.179, -0.338), after(0.196, 1.012, 0.554);
  Handle_motion handle(parameters, home, 0.001);
  const auto go = [&](const Vector3d& from, const Vector3d& to) { // as a hand does; the last condition number
    double condition = 0;
    for (int k = 0; k <= 200; ++k)
      condition = handle.follow(from + k / 200.0 * (to - from));
    return condition;
  };
  go(home.theta, via);
  BOOST_REQUIRE(std::isfinite(go(via, before)));
  BOOST_TEST(!std::isfinite(handle.follow(after)));
  BOOST_TEST((handle.pose().theta - before).norm() <= 1e-12);
  handle.restart();
  BOOST_TEST(handle.follow(after) < 5);
  Handle_motion anew(parameters, home, 0.001);
  anew.follow(after);
  BOOST_TEST((handle.position() - anew.position()).norm() <= 1e-12);
}

} // namespace
