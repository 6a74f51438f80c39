// SPDX-License-Identifier: GPL-3.0-or-later
// A file of its own: together with the kinematics it takes the compiler more than 4 GiB under the sanitizers.
#include "Mpfr_scalar.h"
#include "populations.h"
#include <boost/test/unit_test.hpp>

using namespace device_populations;

BOOST_AUTO_TEST_SUITE(device_scalars)

BOOST_AUTO_TEST_CASE(every_scalar_solves_the_same_device) {
  using Precise = Mpfr<50>;
  for (Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_description<double> design = named_design<double>(Named_design::D1, form);
    const Device_vector<double> theta(0.75, 1.0, 1.25);
    const auto pose = forward_kinematics(Device_parameters<double>(design), theta);
    const auto coarse = forward_kinematics(Device_parameters<float>(description_as<float>(design)), vector_as<float>(theta));
    const auto fine = forward_kinematics(Device_parameters<long double>(description_as<long double>(design)), vector_as<long double>(theta));
    const auto exact = forward_kinematics(Device_parameters<Precise>(description_as<Precise>(design)), vector_as<Precise>(theta));
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

BOOST_AUTO_TEST_SUITE_END()
