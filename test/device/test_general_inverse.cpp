// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/kinematics_of_tests.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

BOOST_AUTO_TEST_SUITE(device_kinematics)

BOOST_AUTO_TEST_CASE(inverse_of_the_general_form_finds_what_a_denser_search_finds) {
  Random random(seed + 5);
  for (int k = 0; k < 6; ++k) {
    const Device_parameters<double> parameters(
        named_design<double>(k % 2 ? Named_design::D1 : Named_design::D2, Device_form::general));
    const auto pose = general_forward(parameters, random_angles(random, 0.6, 1.2));
    const std::vector<Device_pose<double>> all = general_inverse_all(parameters, pose->position);
    BOOST_TEST(!all.empty());
    int missed = 0, found = 0;
    for (int start = 0; start < 4000; ++start) {
      Device_pose<double> trial;
      trial.theta = random_angles(random, -0.5, 2.5);
      trial.orientation =
          (Eigen::AngleAxisd(uniform(random, 0, 1.5), random_vector(random, 1).normalized())).toRotationMatrix();
      if (!internal::inverse_newton<double>(parameters, pose->position, trial, 60))
        continue;
      internal::reduce_angles(parameters, trial.theta);
      if (!within_joint_limits<double>(parameters, trial.theta) || !platform_above_elbows(trial))
        continue;
      ++found;
      missed += std::none_of(all.begin(), all.end(), [&](const Device_pose<double>& other) {
        return (other.theta - trial.theta).norm() < 1e-6 && (other.orientation - trial.orientation).norm() < 1e-6;
      });
    }
    BOOST_TEST_MESSAGE(all.size() << " solutions; random starts reached " << found << " times, " << missed
                                  << " times an unknown one");
    BOOST_TEST(found > 100);
    BOOST_TEST(missed == 0);
  }
  const Device_parameters<double> parameters(named_design<double>(Named_design::D1, Device_form::general));
  BOOST_TEST(general_inverse_all(parameters, Vector(0, 0, 0.4)).empty());
  const auto start = general_forward(parameters, Vector(1, 1, 1));
  const auto far = general_inverse(parameters, Vector(0, 0, 0.4), *start);
  BOOST_TEST((far.status() == Device_status::unreachable));
  BOOST_TEST(far.shortfall() > 0.2);
  for (const double x : {1e154, 1e155, 1e300}) { // whose squares are too large
    const auto farther = general_inverse(parameters, Vector(x, 0, 0), *start);
    BOOST_TEST((farther.status() == Device_status::unreachable && farther.shortfall() > 0.99 * x));
  }
}

// Angles of half a turn, of which rounding makes one turn or the other.
BOOST_AUTO_TEST_CASE(inverse_of_the_general_form_gives_one_pose_once) {
  Device_description<double> d = named_design<double>(Named_design::D1, Device_form::general);
  d.least_angle.setConstant(-100), d.greatest_angle.setConstant(100);
  const Device_parameters<double> parameters(d);
  int found = 0;
  for (const Vector& theta : {Vector(EIGEN_PI, 1.2, 0.8), Vector(EIGEN_PI, EIGEN_PI, EIGEN_PI)}) {
    const auto pose = forward_by_all_modes(parameters, theta);
    BOOST_REQUIRE(static_cast<bool>(pose));
    const auto all = general_inverse_all(parameters, pose->position);
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        BOOST_TEST(
            ((all[i].elbows - all[j].elbows).norm() > 1e-6 || (all[i].orientation - all[j].orientation).norm() > 1e-6));
    found += static_cast<int>(all.size());
  }
  BOOST_TEST(found > 0);
}

// Limits count angles as given: where they ask for the turn beside, angles are of that.
BOOST_AUTO_TEST_CASE(inverse_of_the_general_form_gives_angles_within_limits_beyond_a_half_turn) {
  Device_description<double> d = named_design<double>(Named_design::D1, Device_form::general);
  Random random(seed + 9);
  int found = 0, beyond = 0;
  for (const double least : {2.0, -5.0, 8.0, -11.0, 14.5}) {
    d.least_angle.setConstant(least), d.greatest_angle.setConstant(least + 3);
    const Device_parameters<double> parameters(d);
    for (int k = 0; k < 60; ++k) {
      const Vector theta = random_angles(random, least, least + 3);
      const auto pose = general_forward(parameters, theta);
      if (!pose || !platform_above_elbows(*pose))
        continue;
      ++found;
      beyond += theta.cwiseAbs().maxCoeff() > 3.15;
      const auto same = general_inverse(parameters, pose->position, *pose);
      BOOST_TEST((same && (same->theta - theta).norm() < 1e-9));
      if (found % 8 != 1)
        continue;
      const auto all = general_inverse_all(parameters, pose->position);
      BOOST_TEST(std::any_of(all.begin(), all.end(),
                             [&](const Device_pose<double>& other) { return (other.theta - theta).norm() < 1e-6; }));
    }
  }
  BOOST_TEST_MESSAGE("seed " << seed << ": " << found << " poses, " << beyond << " beyond a half turn");
  BOOST_TEST(beyond >= 20);
}

BOOST_AUTO_TEST_CASE(inverse_of_the_mirror_case_names_what_has_no_answer) {
  const Device_parameters<double> parameters(named_design<double>(Named_design::D3, Device_form::general));
  BOOST_REQUIRE(parameters.is_mirror());
  const auto status = [&](double x, double y, double z) {
    return mirror_inverse(parameters, Vector(x, y, z)).status();
  };
  for (const double bad : {1e160, -1e200, 1e308, std::nan(""), std::numeric_limits<double>::infinity()}) {
    BOOST_TEST((status(bad, 0, 0) == Device_status::not_finite));
    BOOST_TEST((status(0, bad, 0) == Device_status::not_finite));
    BOOST_TEST((status(bad, bad, bad) == Device_status::not_finite));
  }
  BOOST_TEST((status(0, 0, 0) == Device_status::singular));
  BOOST_TEST((status(0, 0, 1e150) == Device_status::unreachable));
  // Across leg 0: its elbow stays in the plane y = 0, and the plane that halves the way is y = 0.025.
  BOOST_TEST((status(0, 0.05, 0) == Device_status::unreachable));
}

// Joint limits count angles as they are given, not modulo a turn.
BOOST_AUTO_TEST_CASE(angles_of_the_mirror_case_do_not_know_the_sign_of_a_zero) {
  const Device_parameters<double> parameters(named_design<double>(Named_design::D3, Device_form::general));
  int behind = 0;
  for (const double x : {-0.02, 0.02, -0.01})
    for (const double y : {0.0, 0.01, -0.015}) {
      auto level = mirror_inverse(parameters, Vector(x, y, 0.0)),
           other = mirror_inverse(parameters, Vector(x, y, -0.0));
      BOOST_TEST((level.status() == other.status()));
      for (int leg = 0; leg < 3; ++leg) {
        BOOST_TEST(level.value_to_fill().minus[leg] == other.value_to_fill().minus[leg]);
        BOOST_TEST(level.value_to_fill().plus[leg] == other.value_to_fill().plus[leg]);
        behind += level.value_to_fill().plus[leg] > 3.2;
      }
    }
  BOOST_TEST(behind > 0);
}

BOOST_AUTO_TEST_CASE(inverse_of_the_mirror_case_bears_the_rounding_of_straight_legs) {
  constexpr double upright = 1.5707963267948966;
  for (int k = 1; k < 2000; ++k) {
    Device_description<double> d = named_design<double>(Named_design::D3, Device_form::general);
    d.base_radius = d.platform_radius = 0.03 + 1e-5 * k;
    d.primary_length = d.secondary_length = 0.05 + 3e-5 * k;
    d.platform_inertia = Device_description<double>::disc_inertia(d.platform_mass, d.platform_radius);
    const Device_parameters<double> parameters(d);
    const auto pose = general_forward(parameters, Vector(upright, upright, upright));
    BOOST_REQUIRE(static_cast<bool>(pose));
    const auto inverse = mirror_inverse(parameters, pose->position);
    BOOST_REQUIRE(static_cast<bool>(inverse));
    BOOST_TEST((inverse->minus.array() - upright).abs().maxCoeff() < 1e-7);
    BOOST_TEST((inverse->plus.array() - upright).abs().maxCoeff() < 1e-7);
    const auto higher = mirror_inverse(parameters, Vector((1 + 1e-14) * pose->position));
    BOOST_TEST((higher.status() == Device_status::unreachable));
    BOOST_TEST((higher.shortfall() > 0 && higher.shortfall() < 2e-14));
  }
  // Above the base's centre elbows that halve the way are as high as half of it: the sine of l1's angle is that over
  // l1.
  const Device_description<double> d = named_design<double>(Named_design::D3, Device_form::general);
  for (const double height : {2.5 * d.primary_length, 7.0 * d.primary_length}) {
    const auto far = mirror_inverse(Device_parameters<double>(d), Vector(0, 0, height));
    BOOST_TEST((far.status() == Device_status::unreachable));
    BOOST_TEST(std::abs(far.shortfall() - (height / (2 * d.primary_length) - 1)) < 1e-12);
  }
}

BOOST_AUTO_TEST_SUITE_END()
