// SPDX-License-Identifier: GPL-3.0-or-later
// Designs and angles that no one would ask for, and poses that are singular.
#include "device/kinematics_of_tests.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

BOOST_AUTO_TEST_SUITE(device_kinematics)

BOOST_AUTO_TEST_CASE(whatever_comes_in_nothing_but_numbers_comes_out) {
  Random random(seed + 6);
  const double odd[] = {0.0,
                        -0.0,
                        5e-324,
                        1e-310,
                        1e-200,
                        1e200,
                        1e308,
                        -1,
                        HUGE_VAL,
                        -HUGE_VAL,
                        std::nan(""),
                        0.03,
                        0.07,
                        1.5707963267948966,
                        3.141592653589793};
  auto pick = [&] { return odd[random() % (sizeof(odd) / sizeof(*odd))]; };
  int accepted = 0, solved = 0;
  for (int k = 0; k < 200000; ++k) {
    Device_description<double> d = random_design(random, k % 2 ? Device_form::general : Device_form::ditetrahedral);
    double* fields[] = {&d.base_radius,     &d.primary_length, &d.secondary_length,
                        &d.platform_radius, &d.platform_mass,  &d.rotor_inertia};
    if (k % 4 < 2)
      *fields[random() % 6] = pick();
    if (!violations(d).empty())
      continue;
    ++accepted;
    const Device_parameters<double> parameters(d);
    const Vector theta(k % 3 ? uniform(random, -4, 4) : pick(), pick(), pick()),
        rate(pick(), uniform(random, -1, 1), pick());
    const auto pose = k % 2 ? forward_by_all_modes(parameters, theta) : ditetrahedral_forward(parameters, theta, 1);
    BOOST_TEST_REQUIRE(std::isfinite(pose.shortfall()));
    if (pose) {
      ++solved;
      BOOST_REQUIRE((pose->position.allFinite() && pose->orientation.allFinite() && pose->links.allFinite()));
      BOOST_REQUIRE(residual(parameters, *pose) < 1e-3);
      const auto motion = device_motion(parameters, *pose, rate);
      if (motion)
        BOOST_REQUIRE((motion->jacobian.linear.allFinite() && motion->jacobian_rate.linear.allFinite()));
      const auto torque = spatial_inverse_dynamics(parameters, *pose, rate, Vector(pick(), 0, 1));
      if (torque)
        BOOST_REQUIRE(torque->torque.allFinite());
    }
    const Vector point(pick(), uniform(random, -0.2, 0.2), pick());
    const auto inverse = ditetrahedral_inverse(parameters, point);
    if (inverse)
      BOOST_REQUIRE((inverse->minus.allFinite() && inverse->plus.allFinite()));
  }
  BOOST_TEST_MESSAGE(accepted << " descriptions accepted, " << solved << " poses solved");
  Device_description<double> bad;
  bad.base_radius = -1, bad.primary_length = std::nan(""), bad.platform_mass = -2, bad.torque_limit = 0;
  try {
    Device_parameters<double> parameters(bad);
    BOOST_TEST(false);
  } catch (const Invalid_device_parameters& error) {
    BOOST_TEST(error.violations().size() == 4u);
  }
}

BOOST_AUTO_TEST_CASE(what_overflows_at_a_regular_pose_is_not_named_singular) {
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_parameters<double> parameters(named_design<double>(Named_design::D1, form));
    const auto pose = forward_kinematics(parameters, Vector(0.9, 1, 1.1));
    BOOST_REQUIRE(static_cast<bool>(pose));
    const Vector none = Vector::Zero(), huge(1e155, 0, 0);
    const auto status = [&](const Vector& rate, const Vector& torque) {
      return forward_dynamics(parameters, Dynamics_model::spatial, *pose, rate, torque).status();
    };
    for (const double bad : {std::nan(""), HUGE_VAL, 1e308})
      BOOST_TEST((status(none, Vector(bad, 0, 0)) == Device_status::not_finite));
    BOOST_TEST((status(huge, none) == Device_status::not_finite));
    BOOST_TEST((spatial_inverse_dynamics(parameters, *pose, huge, none).status() == Device_status::not_finite));
    BOOST_TEST((dynamics(parameters, Dynamics_model::spatial, *pose, Vector(1e160, 0, 0)).status() ==
                Device_status::not_finite));
    BOOST_TEST((status(none, none) == Device_status::success));
    Dynamics_terms<double> terms = *dynamics(parameters, Dynamics_model::spatial, *pose, none);
    BOOST_TEST((terms.acceleration_failure() == Device_status::not_finite));
    terms.mass.row(1) = terms.mass.row(0);
    BOOST_TEST((terms.acceleration_failure() == Device_status::singular));
  }
}

BOOST_AUTO_TEST_CASE(elbows_on_a_line_or_in_one_point_are_named_singular) {
  Device_description<double> d;
  d.base_radius = 0.02;
  const Device_parameters<double> point(d);
  const double inward = 2.6004931276326473, outward = 0.5410995259571459; // x = -0.04 for all three elbows
  BOOST_TEST((ditetrahedral_forward(point, Vector(inward, outward, outward), 1).status() == Device_status::singular));
  BOOST_TEST((ditetrahedral_forward(point, Vector(inward + 1e-4, outward, outward), 1).status() ==
              Device_status::unreachable));
  d.form = Device_form::general;
  const Device_parameters<double> platform(d);
  const Vector in_line(inward, outward, outward), beside(inward + 1e-4, outward, outward);
  BOOST_TEST((forward_by_all_modes(platform, in_line).status() == Device_status::singular));
  BOOST_TEST((forward_by_all_modes(platform, beside).status() == Device_status::success));
  d.form = Device_form::ditetrahedral;
  d.primary_length = 0.04; // acos(-1/2): all elbows on the axis
  const double together = 2.0943951023931957;
  BOOST_TEST((ditetrahedral_forward(Device_parameters<double>(d), Vector(together, together, together), 1).status() ==
              Device_status::singular));
}

// The orientation is a product of frames of two triangles, whose areas' squares are eighth powers of lengths.
BOOST_AUTO_TEST_CASE(orientations_of_the_largest_and_the_smallest_devices_are_those_of_usual_ones) {
  const auto orientation = [](double size) {
    Device_description<float> d;
    d.form = Device_form::general;
    d.base_radius = d.platform_radius = d.primary_length = static_cast<float>(size);
    d.secondary_length = static_cast<float>(0.96875 * size);
    const Device_parameters<float> parameters(d);
    const auto pose = forward_kinematics(parameters, Device_vector<float>(0.3f, 0.35f, 0.4f));
    BOOST_REQUIRE(static_cast<bool>(pose));
    return Device_matrix<float>(pose->orientation);
  };
  const Device_matrix<float> usual = orientation(1);
  for (const int exponent : {-15, -7, 7, 14}) // of floats, near both ends of what is taken
    BOOST_TEST((orientation(std::ldexp(1.9, exponent)) - usual).cwiseAbs().maxCoeff() < 1e-4,
               "2^" << exponent);
}

BOOST_AUTO_TEST_SUITE_END()
