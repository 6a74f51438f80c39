// SPDX-License-Identifier: GPL-3.0-or-later
// From the wanted force to torques: room of the motors, limits, fading.
#include "haptic_rendering/devices_of_tests.h"

#include <haptic_sculpt/haptic_rendering/Force_limit.h>
#include <haptic_sculpt/haptic_rendering/Force_renderer.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

using namespace haptic_sculpt;
using namespace haptic_rendering_tests;

namespace {

BOOST_AUTO_TEST_CASE(torques_are_scaled_together_into_the_room) {
  Random random(3);
  std::size_t limited = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vector3d torque = random_vector(random, 0.2),
                   carried = random_vector(random, 0.05).cwiseMax(-0.2).cwiseMin(0.2);
    const double share = share_in_room(torque, carried, 0.2);
    BOOST_TEST(share >= 0);
    BOOST_TEST(share <= 1);
    const Vector3d sum = carried + share * torque;
    BOOST_TEST(sum.cwiseAbs().maxCoeff() <= 0.2 * (1 + 1e-15));
    if (share < 1) {
      ++limited;
      BOOST_TEST(sum.cwiseAbs().maxCoeff() >= 0.2 * (1 - 1e-12)); // no more than is needed
    }
  }
  BOOST_TEST(limited > 1000u);
}

BOOST_AUTO_TEST_CASE(limits_keep_the_direction_and_the_torques_are_those_of_the_force_and_the_weight) {
  Random random(4);
  std::uniform_real_distribution<double> angle(0.4, 1.6);
  std::size_t limited = 0;
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_parameters<double> parameters = device(form, 0.005);
    for (int i = 0; i < 500; ++i) {
      const double a = angle(random), b = angle(random), c = angle(random);
      const Handle_motion handle = handle_at(parameters, Vector3d(a, b, c));
      if (!(handle.condition() < 10))
        continue;
      Force_limits limits;
      limits.slew = 1e9, limits.ramp_time = 1e-9, limits.largest = 1e3;
      Force_renderer renderer(limits, Gravity_compensation::spatial, 0.001);
      const Vector3d wanted = random_vector(random, 5);
      const Rendered_force rendered = renderer.render(handle, wanted);
      BOOST_TEST(rendered.force.cross(wanted).norm() <= 1e-14 * rendered.force.norm() * wanted.norm());
      BOOST_TEST(rendered.force.dot(wanted) >= 0);
      limited += rendered.force.norm() < 0.999 * wanted.norm();
      const Vector3d weight = gravity_torque(parameters, handle.pose(), handle.jacobian());
      BOOST_TEST((rendered.torque - weight - handle.jacobian().linear.transpose() * rendered.force).norm() <= 1e-15);
    }
  }
  BOOST_TEST(limited > 100u);
}

BOOST_AUTO_TEST_CASE(forces_fade_where_the_jacobian_is_bad) {
  const Force_limits limits;
  BOOST_TEST(fading_by_condition(limits, 1) == 1);
  BOOST_TEST(fading_by_condition(limits, 10) == 1);
  BOOST_TEST(std::abs(fading_by_condition(limits, 15) - 0.5) <= 1e-15);
  BOOST_TEST(fading_by_condition(limits, 20) == 0);
  BOOST_TEST(fading_by_condition(limits, std::numeric_limits<double>::infinity()) == 0);
  BOOST_TEST(fading_by_condition(limits, NAN) == 0);
}

BOOST_AUTO_TEST_CASE(slew_limit_and_clamp) {
  Slew_limit slew;
  const Vector3d wanted(3, 0, 4);
  for (int k = 1; k < 16; ++k)
    BOOST_TEST(std::abs(slew.follow(wanted, 0.3).norm() - 0.3 * k) <= 1e-12);
  slew.follow(wanted, 0.3), slew.follow(wanted, 0.3);
  BOOST_TEST(slew.value() == wanted);
  int ticks = 0;
  while (slew.follow(Vector3d::Zero(), 0.3) != Vector3d::Zero())
    ++ticks;
  BOOST_TEST(ticks <= 17); // |F| / slew = 16.7 ticks, and exactly 0 then
  BOOST_TEST(std::abs(clamped(Vector3d(30, 0, 40), 5).norm() - 5) <= 1e-14);
  BOOST_TEST(clamped(wanted, 5.1) == wanted);
}

BOOST_AUTO_TEST_CASE(a_fault_fades_to_exactly_nothing_in_its_time) {
  const Device_parameters<double> parameters = device(Device_form::ditetrahedral, 0.005);
  const Handle_motion handle = handle_at(parameters, Vector3d(1, 1.1, 0.9));
  for (const double rate : {250.0, 1000.0, 10000.0}) {
    Force_renderer renderer(Force_limits(), Gravity_compensation::spatial, 1 / rate);
    Rendered_force last;
    for (int k = 0; k < rate; ++k)
      last = renderer.render(handle, Vector3d(0, 0, 2));
    BOOST_TEST(std::abs(last.force.norm() - 2) <= 1e-12);
    int ticks = 0;
    for (double before = 2; !renderer.has_faded(); ++ticks) {
      last = renderer.fade_out();
      BOOST_TEST(last.force.norm() <= before);
      BOOST_TEST(before - last.force.norm() <= 2 * 1.01 / (0.1 * rate));
      before = last.force.norm();
    }
    BOOST_TEST(last.force == Vector3d::Zero());
    BOOST_TEST(last.torque == Vector3d::Zero());
    BOOST_TEST(std::abs(ticks / rate - 0.1) <= 1.01 / rate);
  }
}

} // namespace
