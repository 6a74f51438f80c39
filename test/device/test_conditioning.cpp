// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/simulation/coupled_hand.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

BOOST_AUTO_TEST_SUITE(device_simulation)

BOOST_AUTO_TEST_CASE(singular_values_of_the_position_jacobian_against_differences_and_another_decomposition) {
  BOOST_TEST_MESSAGE("seed " << seed);
  Random random(seed);
  double worst = 0, worst_direction = 0;
  int used = 0;
  for (Device_form form : both_forms)
    for (int k = 0; k < 300; ++k) {
      const Device_description<double> design = random_design(random, form);
      const Device_parameters<double> parameters(design);
      const Device_parameters<Long> fine(description_as<Long>(design));
      const Vector theta = random_angles(random, 0.5, 1.5);
      const auto pose = forward_kinematics(parameters, theta);
      if (!pose || conditioning(parameters, *pose)->constraint_condition > 20)
        continue;
      const auto map = jacobian(parameters, *pose);
      const auto found = translation_conditioning(*map);
      // The Jacobian once more, as differences of places in long double, and its values by Eigen.
      const auto start = forward_kinematics(fine, vector_as<Long>(theta));
      const Long h = 1e-4L;
      Device_matrix<Long> difference;
      for (int joint = 0; joint < 3; ++joint) {
        Device_vector<Long> column = Device_vector<Long>::Zero();
        for (int step : {-2, -1, 1, 2}) {
          Device_vector<Long> moved = vector_as<Long>(theta);
          moved[joint] += step * h;
          column += (step == 1 || step == -1 ? 8.0L : -1.0L) * (step > 0 ? 1 : -1) / (12 * h) *
                    forward_kinematics(fine, moved, *start)->position;
        }
        difference.col(joint) = column;
      }
      const Device_vector<Long> values = Eigen::JacobiSVD<Device_matrix<Long>>(difference).singularValues();
      const double greatest = static_cast<double>(values[0]), least = static_cast<double>(values[2]);
      worst =
          std::max({worst, std::abs(found.greatest - greatest) / greatest, std::abs(found.least - least) / greatest});
      BOOST_TEST(found.condition == found.greatest / found.least);
      for (int direction = 0; direction < 20; ++direction) { // no joint rate moves the centre faster or slower
        const double speed = (map->linear * random_vector(random, 1).normalized()).norm();
        worst_direction =
            std::max({worst_direction, speed / found.greatest - 1, (found.least - speed) / found.greatest});
      }
      ++used;
    }
  BOOST_TEST_MESSAGE(used << " poses: singular values off by " << worst << " of the greatest");
  BOOST_TEST(used > 300);
  BOOST_TEST(worst < 1e-8);
  BOOST_TEST(worst_direction < 1e-14);
  // A straight knee: its joint moves nothing, and in that direction nothing can be moved or felt.
  const Device_parameters<double> parameters(named_design<double>(Named_design::D1, Device_form::ditetrahedral));
  Device_jacobian<double> flat;
  flat.linear << 0.1, 0.2, 0, 0.3, 0.1, 0, 0.2, 0.1, 0;
  flat.angular.setZero();
  BOOST_TEST(translation_conditioning(flat).condition > 1e15);
  flat.linear.setZero();
  BOOST_TEST((translation_conditioning(flat).condition == HUGE_VAL && translation_conditioning(flat).least == 0));
}

BOOST_AUTO_TEST_SUITE_END()
