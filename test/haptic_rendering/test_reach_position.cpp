// SPDX-License-Identifier: GPL-3.0-or-later
// Poses that are reached along a straight way, and the ball in which they are.
#include <haptic_sculpt/haptic_rendering/reach_position.h>

#include <boost/test/unit_test.hpp>

#include <Eigen/SVD>
#include <cmath>
#include <limits>

using namespace haptic_sculpt;
using Eigen::Vector3d;

namespace {

Device_parameters<double> device_of_size(double size) {
  Device_description<double> description = named_design<double>(Named_design::D1, Device_form::ditetrahedral);
  description.base_radius *= size, description.primary_length *= size, description.secondary_length *= size;
  return Device_parameters<double>(description);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_reached_is_said_however_far_it_is) {
  const Device_parameters<double> device = device_of_size(1);
  const auto home = home_pose(device);
  const Vector3d near = home->position + Vector3d(0.01, -0.02, 0.005);
  const auto reached = reach_position(device, *home, near);
  BOOST_REQUIRE(static_cast<bool>(reached));
  BOOST_TEST((reached->position - near).norm() <= 1e-12);
  const auto tried = [&](int axis, double value) {
    Vector3d place = home->position;
    place[axis] = value;
    return reach_position(device, *home, place);
  };
  for (const double far : {0.3, 1.0, 3e6, 1e10, 1e154, 1e300, -1e300})
    for (int axis = 0; axis < 3; ++axis) {
      const auto there = tried(axis, far);
      BOOST_TEST((there.status() == Device_status::unreachable));
      BOOST_TEST(there.shortfall() >= 0.4 * std::abs(far));
    }
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1.9e305, -1e308})
    for (int axis = 0; axis < 3; ++axis)
      BOOST_TEST((tried(axis, bad).status() == Device_status::not_finite));
}

/// cond(J) by differences.
double condition_at(const Device_parameters<double>& device, const Device_pose<double>& pose) {
  Eigen::Matrix3d J;
  for (int leg = 0; leg < 3; ++leg) {
    const Vector3d step = 1e-5 * Vector3d::Unit(leg);
    J.col(leg) = forward_kinematics(device, Vector3d(pose.theta + step), pose)->position -
                 forward_kinematics(device, Vector3d(pose.theta - step), pose)->position;
  }
  const Vector3d singular = J.jacobiSvd().singularValues();
  return singular[0] / singular[2];
}

BOOST_AUTO_TEST_CASE(the_pose_that_is_reached_is_conditioned_as_asked) {
  const Device_parameters<double> device = device_of_size(1);
  const auto home = home_pose(device);
  const double at_home = condition_at(device, *home); // about 1.5
  for (const double most : {1.0, 0.999 * at_home})
    BOOST_TEST((reach_position(device, *home, home->position, most).status() == Device_status::unreachable));
  BOOST_TEST((reach_position(device, *home, home->position, 1.001 * at_home).status() == Device_status::success));
  int worse = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double way : {-0.9e-3, 0.9e-3, -0.03, 0.03}) { // one step, and many
      const Vector3d there = home->position + way * Vector3d::Unit(axis);
      const auto pose = reach_position(device, *home, there);
      BOOST_REQUIRE(static_cast<bool>(pose));
      const double condition = condition_at(device, *pose);
      if (condition < 1.002 * at_home)
        continue;
      ++worse;
      BOOST_TEST((reach_position(device, *home, there, 0.9995 * condition).status() == Device_status::unreachable));
      BOOST_TEST((reach_position(device, *home, there, 1.0005 * condition).status() == Device_status::success));
    }
  BOOST_TEST(worse >= 6);
}

BOOST_AUTO_TEST_CASE(a_device_a_thousand_times_as_large_has_a_workspace_as_much_larger) {
  double radius[2];
  int k = 0;
  for (const double size : {1.0, 1000.0}) {
    const Device_parameters<double> device = device_of_size(size);
    radius[k++] = workspace_radius(device, *home_pose(device)) / size;
  }
  BOOST_TEST(radius[0] > 0.01);
  BOOST_TEST(std::abs(radius[0] - radius[1]) <= 1e-3); // the step of the small one
}

} // namespace
