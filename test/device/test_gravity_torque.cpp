// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/simulation/coupled_hand.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

BOOST_AUTO_TEST_SUITE(device_simulation)

BOOST_AUTO_TEST_CASE(gravity_alone_is_the_slope_of_the_potential_energy) {
  Random random(seed + 1);
  double worst = 0, worst_slope = 0;
  for (Device_form form : both_forms)
    for (int k = 0; k < 300; ++k) {
      Device_description<double> design = random_design(random, form);
      design.gravity = uniform(random, -12, 12);
      const Device_parameters<double> parameters(design);
      const Device_parameters<Long> fine(description_as<Long>(design));
      const Vector theta = random_angles(random, 0.5, 1.5);
      const auto pose = forward_kinematics(parameters, theta);
      if (!pose || conditioning(parameters, *pose)->constraint_condition > 20)
        continue;
      const Vector found = gravity_torque(parameters, *pose, *jacobian(parameters, *pose));
      const auto terms = dynamics(parameters, Dynamics_model::spatial, *pose, Vector(Vector::Zero()));
      worst = std::max(worst, (found - terms->gravity).norm() / terms->gravity.norm());
      const auto start = forward_kinematics(fine, vector_as<Long>(theta));
      const auto potential = [&](const Device_vector<Long>& angles) { // from the places of the parts alone
        const auto there = forward_kinematics(fine, angles, *start);
        Long height = fine.platform_mass() * there->position[2];
        for (int leg = 0; leg < 3; ++leg)
          height += fine.primary_mass() * there->elbows(2, leg) / 2 +
                    fine.secondary_mass() * (there->elbows(2, leg) + there->joints(2, leg)) / 2;
        return Long(fine.gravity() * height);
      };
      for (int joint = 0; joint < 3; ++joint) {
        const Long h = 1e-5L;
        Device_vector<Long> ahead = vector_as<Long>(theta), behind = ahead;
        ahead[joint] += h, behind[joint] -= h;
        const double slope = static_cast<double>((potential(ahead) - potential(behind)) / (2 * h));
        worst_slope = std::max(worst_slope, std::abs(slope - found[joint]) / found.norm());
      }
    }
  BOOST_TEST_MESSAGE("gravity: from the whole model " << worst << ", from differences of the potential " << worst_slope
                                                      << " (relative)");
  BOOST_TEST(worst < 1e-13);
  BOOST_TEST(worst_slope < 1e-7);
}

BOOST_AUTO_TEST_SUITE_END()
