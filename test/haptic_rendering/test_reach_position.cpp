// SPDX-License-Identifier: GPL-3.0-or-later
// Poses that are reached along a straight way, and the ball in which they are.
#include <haptic_sculpt/haptic_rendering/reach_position.h>

#include <boost/test/unit_test.hpp>

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
