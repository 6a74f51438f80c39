// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/kinematics_of_tests.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>

BOOST_AUTO_TEST_SUITE(device_kinematics)

BOOST_AUTO_TEST_CASE(jacobian_and_its_derivative_against_differences) {
  using Long = long double;
  Random random(seed + 4);
  double worst = 0, worst_rate = 0;
  for (Device_form form : {Device_form::ditetrahedral, Device_form::general})
    for (int k = 0; k < 300; ++k) {
      const Device_description<double> design = random_design(random, form);
      const Device_parameters<double> parameters(design);
      const Device_parameters<Long> fine(description_as<Long>(design));
      const Vector theta = random_angles(random, 0.5, 1.5), rate = random_vector(random, 3);
      const auto pose = forward_kinematics(parameters, theta);
      if (!pose || conditioning(parameters, *pose)->constraint_condition > 20)
        continue;
      const auto motion = device_motion(parameters, *pose, rate);
      const auto start = forward_kinematics(fine, vector_as<Long>(theta));
      const Long h = 2e-5L; // fourth-order differences: truncation about h^4
      Device_matrix<Long> difference = Device_matrix<Long>::Zero();
      Eigen::Matrix<Long, 6, 3> jacobian_difference = Eigen::Matrix<Long, 6, 3>::Zero();
      for (int joint = 0; joint < 3; ++joint) {
        Device_vector<Long> column = Device_vector<Long>::Zero();
        for (int step : {-2, -1, 1, 2}) {
          const Long weight = (step == 1 || step == -1 ? 8.0L : -1.0L) * (step > 0 ? 1 : -1) / (12 * h);
          Device_vector<Long> moved = vector_as<Long>(theta);
          moved[joint] += step * h;
          column += weight * forward_kinematics(fine, moved, *start)->position;
        }
        difference.col(joint) = column;
      }
      for (int step : {-2, -1, 1, 2}) {
        const Long weight = (step == 1 || step == -1 ? 8.0L : -1.0L) * (step > 0 ? 1 : -1) / (12 * h);
        const auto moved = forward_kinematics(
            fine, Device_vector<Long>(vector_as<Long>(theta) + step * h * vector_as<Long>(rate)), *start);
        const auto map = jacobian(fine, *moved);
        jacobian_difference.topRows<3>() += weight * map->linear;
        jacobian_difference.bottomRows<3>() += weight * map->angular;
      }
      worst = std::max(worst,
                       (difference.cast<double>() - motion->jacobian.linear).norm() / motion->jacobian.linear.norm());
      Eigen::Matrix<double, 6, 3> rates;
      rates << motion->jacobian_rate.linear, motion->jacobian_rate.angular;
      worst_rate = std::max(worst_rate, (jacobian_difference.cast<double>() - rates).norm() / rates.norm());
    }
  BOOST_TEST_MESSAGE("Jacobian differs from differences by " << worst << ", its derivative by " << worst_rate
                                                             << " (relative)");
  BOOST_TEST(worst < 1e-8);
  BOOST_TEST(worst_rate < 1e-7);
}

BOOST_AUTO_TEST_SUITE_END()
