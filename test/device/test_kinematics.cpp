// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of the mechanism hold, there and back, by either solver.
#include "device/kinematics_of_tests.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

BOOST_AUTO_TEST_SUITE(device_kinematics)

BOOST_AUTO_TEST_CASE(nine_equations_hold_in_a_million_random_poses_of_each_form) {
  BOOST_TEST_MESSAGE("seed " << seed);
  Random random(seed);
  for (Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    int solved = 0, failed = 0;
    double worst = 0;
    for (int design = 0; design < 1000; ++design) {
      const Device_parameters<double> parameters(random_design(random, form));
      for (int k = 0; k < 1000; ++k) {
        const auto pose = forward_by_all_modes(parameters, random_angles(random, -0.5, 2.5));
        if (!pose) {
          ++failed;
          continue;
        }
        ++solved;
        const double r = residual(parameters, *pose);
        if (r > 1e-14) { // the condition number is at least 1, so below that there is nothing to divide by
          const auto c = conditioning(parameters, *pose);
          worst = std::max(worst, r / c->constraint_condition);
        } else
          worst = std::max(worst, r / 10);
      }
    }
    BOOST_TEST_MESSAGE((form == Device_form::general ? "general: " : "di-tetrahedral: ")
                       << solved << " poses, " << failed << " refused, worst residual / condition " << worst);
    BOOST_TEST(worst <= 1e-14);
    BOOST_TEST(solved > 200000);
  }
}

// An angle is in (-pi, pi], where sine and cosine are exact, too.
BOOST_AUTO_TEST_CASE(a_level_folded_knee_is_at_plus_pi) {
  Device_description<double> description;
  description.base_radius = 1, description.primary_length = 2, description.secondary_length = 3;
  const Device_parameters<double> parameters(description);
  const auto angles = ditetrahedral_inverse(parameters, Vector(2, 0, 0), Eigen::Vector3i(0, 0, 0));
  BOOST_REQUIRE(static_cast<bool>(angles));
  BOOST_TEST(angles->theta[0] == std::acos(-1.0));
}

BOOST_AUTO_TEST_CASE(there_and_back) {
  Random random(seed + 1);
  double worst_point = 0, worst_general = 0;
  int tried = 0, general_tried = 0, general_failed = 0;
  for (int k = 0; k < 20000; ++k) {
    const Device_parameters<double> parameters(random_design(random, Device_form::ditetrahedral));
    const Vector theta = random_angles(random, 0.2, 2);
    for (int mode : {1, -1}) {
      const auto pose = ditetrahedral_forward(parameters, theta, mode);
      if (!pose)
        continue;
      const auto c = conditioning(parameters, *pose);
      const auto all = ditetrahedral_inverse(parameters, pose->position);
      const Eigen::Vector3i knees = working_mode(parameters, *pose);
      const auto one = ditetrahedral_inverse(parameters, pose->position, knees);
      BOOST_REQUIRE((all && one));
      for (int leg = 0; leg < 3; ++leg) {
        const double sensitivity = c->constraint_condition / std::sqrt(std::max(all->one_minus_cosine[leg], 1e-15));
        worst_point = std::max(
            worst_point,
            std::abs(std::remainder((knees[leg] ? all->plus : all->minus)[leg] - theta[leg], 2 * std::acos(-1.0))) /
                sensitivity);
        worst_point = std::max(
            worst_point, std::abs(std::remainder(one->theta[leg] - theta[leg], 2 * std::acos(-1.0))) / sensitivity);
      }
      for (int choice = 0; choice < 8; ++choice) { // all eight bring the apex to the point, on one side or the other
        Vector angles;
        for (int leg = 0; leg < 3; ++leg)
          angles[leg] = (choice >> leg & 1 ? all->plus : all->minus)[leg];
        const auto again =
            ditetrahedral_forward(parameters, angles, ditetrahedral_mode(parameters, angles, pose->position));
        const auto c2 = again ? conditioning(parameters, *again) : Outcome<Conditioning<double>>();
        if (again && c2 && c2->constraint_condition < 1e6)
          BOOST_TEST(((again->position - pose->position).norm() <=
                      1e-14 * c2->constraint_condition * parameters.secondary_length() * 10));
      }
      ++tried;
    }
  }
  for (int k = 0; k < 5000; ++k) {
    const Device_parameters<double> parameters(random_design(random, Device_form::general));
    const Vector theta = random_angles(random, 0.5, 1.5);
    const auto pose = general_forward(parameters, theta),
               near = general_forward(parameters, Vector(theta + random_vector(random, 0.01)));
    if (!pose || !near)
      continue;
    const auto c = conditioning(parameters, *pose);
    const auto map = jacobian(parameters, *pose);
    const Device_matrix<double> inverse_map = map->linear.inverse();
    if (!c || c->constraint_condition > 30 || inverse_map.norm() * parameters.secondary_length() > 30)
      continue;
    ++general_tried;
    const auto back = general_inverse(parameters, pose->position, *near);
    if (!back) {
      ++general_failed;
      continue;
    }
    worst_general = std::max(worst_general, (back->theta - theta).cwiseAbs().maxCoeff() / c->constraint_condition);
  }
  BOOST_TEST_MESSAGE(tried << " apexes: worst angle error " << worst_point << " x condition; " << general_tried
                           << " platforms: " << worst_general << " x condition");
  BOOST_TEST(worst_point <= 1e-14);
  BOOST_TEST(worst_general <= 1e-13);
  BOOST_TEST(general_failed == 0);
  BOOST_TEST(general_tried > 1000);
}

BOOST_AUTO_TEST_CASE(mirror_case_agrees_with_the_general_solver) {
  Random random(seed + 2);
  for (int k = 0; k < 2000; ++k) {
    Device_description<double> d = random_design(random, Device_form::general);
    d.platform_radius = d.base_radius;
    d.secondary_length = d.primary_length;
    const Device_parameters<double> parameters(d);
    BOOST_REQUIRE(parameters.is_mirror());
    const Vector theta = random_angles(random, 0.4, 1.6);
    const auto closed = mirror_forward(parameters, theta);
    BOOST_REQUIRE(static_cast<bool>(closed));
    const auto iterated =
        forward_by_all_modes<double>(parameters, theta, Vector(-theta + random_vector(random, 1e-4)));
    BOOST_REQUIRE(static_cast<bool>(iterated));
    BOOST_TEST((closed->position - iterated->position).norm() < 1e-12);
    BOOST_TEST((closed->orientation - iterated->orientation).norm() < 1e-11);
    const auto inverse = mirror_inverse(parameters, closed->position);
    BOOST_REQUIRE(static_cast<bool>(inverse));
    for (int leg = 0; leg < 3; ++leg)
      BOOST_TEST(std::min(std::abs(inverse->minus[leg] - theta[leg]), std::abs(inverse->plus[leg] - theta[leg])) <
                 1e-8);
  }
}

BOOST_AUTO_TEST_SUITE_END()
