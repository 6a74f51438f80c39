// SPDX-License-Identifier: GPL-3.0-or-later
// A file of its own: together with the kinematics it takes the compiler more than 4 GiB under the sanitizers.
#include "Mpfr_scalar.h"
#include "populations.h"
#include <boost/test/unit_test.hpp>

#include <unsupported/Eigen/AutoDiff>

using namespace device_populations;

BOOST_AUTO_TEST_SUITE(device_scalars)

BOOST_AUTO_TEST_CASE(every_scalar_solves_the_same_device) {
  using Precise = Mpfr<50>;
  for (Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_description<double> design = named_design<double>(Named_design::D1, form);
    const Device_vector<double> theta(0.75, 1.0, 1.25);
    const auto pose = forward_kinematics(Device_parameters<double>(design), theta);
    const auto coarse =
        forward_kinematics(Device_parameters<float>(description_as<float>(design)), vector_as<float>(theta));
    const auto fine = forward_kinematics(Device_parameters<long double>(description_as<long double>(design)),
                                         vector_as<long double>(theta));
    const auto exact =
        forward_kinematics(Device_parameters<Precise>(description_as<Precise>(design)), vector_as<Precise>(theta));
    BOOST_REQUIRE((pose && coarse && fine && exact));
    for (int k = 0; k < 3; ++k) {
      BOOST_TEST(std::abs(coarse->position[k] - pose->position[k]) < 1e-7);
      BOOST_TEST(std::abs(static_cast<double>(fine->position[k]) - pose->position[k]) < 1e-15);
      BOOST_TEST(std::abs(static_cast<double>(exact->position[k]) - pose->position[k]) < 1e-15);
    }
    const Device_parameters<Precise> parameters(description_as<Precise>(design));
    const auto r = nine_equation_residual(parameters, exact->elbows, exact->joints).cwiseAbs().maxCoeff();
    BOOST_TEST(static_cast<double>(r) < 1e-46);
  }
}

BOOST_AUTO_TEST_CASE(derivatives_by_automatic_differentiation_are_the_jacobian) {
  using Derived = Eigen::AutoDiffScalar<Eigen::Vector3d>;
  constexpr unsigned seed = 31;
  BOOST_TEST_MESSAGE("seed " << seed);
  Random random(seed);
  for (Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_parameters<double> parameters(named_design<double>(Named_design::D1, form));
    const Device_parameters<Derived> derived_parameters(named_design<Derived>(Named_design::D1, form));
    int used = 0;
    for (int k = 0; k < 200; ++k) {
      const Device_vector<double> theta = random_angles(random, 0.7, 1.4);
      const Device_vector<Derived> seeded(Derived(theta[0], 3, 0), Derived(theta[1], 3, 1), Derived(theta[2], 3, 2));
      const auto pose = forward_kinematics(parameters, theta);
      const auto derived = forward_kinematics(derived_parameters, seeded);
      if (!pose || !derived)
        continue;
      const auto map = jacobian(parameters, *pose);
      if (!map || translation_conditioning(*map).condition > 50)
        continue;
      ++used;
      for (int i = 0; i < 3; ++i)
        BOOST_TEST((derived->position[i].derivatives().transpose() - map->linear.row(i)).norm() <=
                   1e-11 * map->linear.norm());
    }
    BOOST_TEST(used > 100);
  }
}

BOOST_AUTO_TEST_SUITE_END()
