// SPDX-License-Identifier: GPL-3.0-or-later
// A file of its own: together with the kinematics it takes the compiler more than 4 GiB under the sanitizers.
#include "Mpfr_scalar.h"
#include "populations.h"
#include <seeds_and_sizes.h>

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

// Also where the place is level, and its sign is taken away.
BOOST_AUTO_TEST_CASE(derivatives_of_the_inverses_live_on_at_a_height_of_zero) {
  using Derived = Eigen::AutoDiffScalar<Eigen::Vector3d>;
  const auto at = [](double x, double y, double z) {
    return Device_vector<Derived>(Derived(x, 3, 0), Derived(y, 3, 1), Derived(z, 3, 2));
  };
  const Device_parameters<Derived> mirror(named_design<Derived>(Named_design::D3, Device_form::general));
  const Device_parameters<Derived> ditetrahedral(named_design<Derived>(Named_design::D1, Device_form::ditetrahedral));
  int compared = 0;
  for (const double x : {-0.02, 0.015}) {
    auto level = mirror_inverse(mirror, at(x, 0.01, 0.0)), near = mirror_inverse(mirror, at(x, 0.01, 1e-9));
    auto other = ditetrahedral_inverse(ditetrahedral, at(x, 0.01, 0.0)),
         beside = ditetrahedral_inverse(ditetrahedral, at(x, 0.01, 1e-9));
    const auto compare = [&](auto& a, auto& b) {
      for (int leg = 0; leg < 3; ++leg)
        if (a.value_to_fill().leg_reaches[leg] && b.value_to_fill().leg_reaches[leg]) {
          const Eigen::Vector3d slope = b.value_to_fill().plus[leg].derivatives();
          BOOST_TEST((a.value_to_fill().plus[leg].derivatives() - slope).norm() <= 1e-5 * slope.norm());
          BOOST_TEST(std::abs(slope[2]) > 1);
          ++compared;
        }
    };
    compare(level, near), compare(other, beside);
  }
  BOOST_TEST(compared > 3);
}

// Long links that fold back on the base have elbows that are near each other and far out: what they are rounded to
// counts.
BOOST_AUTO_TEST_CASE(the_closure_knows_how_far_the_elbows_are_rounded) {
  Random random(haptic_sculpt::test::seed_from_environment(71));
  double worst = 0, worst_without = 0; // of what is allowed
  for (int k = 0; k < 20000; ++k) {
    Device_description<double> d = random_design(random, Device_form::general);
    d.secondary_length = 1, d.platform_radius = uniform(random, 0.1, 1);
    d.primary_length = std::ldexp(uniform(random, 1, 2), k % 20);
    d.base_radius = d.primary_length + uniform(random, -0.9, 0.9);
    const double spread = k % 2 == 0 ? 3 : 4 / d.primary_length; // rad; folded back
    const Device_vector<double> theta =
        (k % 2 == 0 ? Device_vector<double>::Zero() : Device_vector<double>::Constant(EIGEN_PI)) +
        random_vector(random, spread);
    Device_pose<double> pose;
    Device_pose<long double> fine;
    const Device_parameters<double> parameters(d);
    const Device_parameters<long double> as_fine(description_as<long double>(d));
    internal::place_elbows(parameters, theta, pose);
    internal::place_elbows(as_fine, vector_as<long double>(theta), fine);
    const internal::Platform_closure<double> closure(parameters, pose.elbows);
    const internal::Platform_closure<long double> exact(as_fine, fine.elbows);
    for (int i = 0; i < 3; ++i) {
      const double off = static_cast<double>(std::abs(closure.separation_squared[i] - exact.separation_squared[i]));
      worst = std::fmax(worst, off / closure.residual_rounding());
      worst_without =
          std::fmax(worst_without, off / (closure.residual_rounding() -
                                          std::numeric_limits<double>::epsilon() * closure.rounding_of_elbows));
    }
  }
  BOOST_TEST(worst <= 1);
  BOOST_TEST(worst_without > 2); // else nothing was tried
}

BOOST_AUTO_TEST_SUITE_END()
