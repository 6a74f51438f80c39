// SPDX-License-Identifier: GPL-3.0-or-later
// From the wanted force to torques: room of the motors, limits, fading.
#include "haptic_rendering/devices_of_tests.h"

#include <haptic_sculpt/haptic_rendering/Force_limit.h>
#include <haptic_sculpt/haptic_rendering/Force_renderer.h>
#include <haptic_sculpt/haptic_rendering/Passivity_limits.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <Eigen/SVD>

#include <cmath>
#include <limits>

using namespace haptic_sculpt;
using namespace haptic_rendering_tests;

namespace {

BOOST_AUTO_TEST_CASE(torques_are_scaled_together_into_the_room) {
  Random random(haptic_sculpt::test::seed_from_environment(3));
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
  Random random(haptic_sculpt::test::seed_from_environment(4));
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
      Force_renderer renderer(limits, Virtual_coupling(), Gravity_compensation::spatial, 0.001);
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

BOOST_AUTO_TEST_CASE(where_the_device_has_less_friction_the_force_is_less_and_the_coupling_passive) {
  Random random(haptic_sculpt::test::seed_from_environment(14));
  std::uniform_real_distribution<double> angle(0.2, 1.9);
  const double tick = 0.001, stiffness = 1500, needed = stiffness * tick / 2;
  int scaled = 0, whole = 0;
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_parameters<double> parameters = device(form, 0.005);
    Force_limits limits;
    limits.ramp_time = 0, limits.slew = 1e9;
    for (int i = 0; i < 500; ++i) {
      const double a = angle(random), b = angle(random), c = angle(random);
      const Handle_motion handle = handle_at(parameters, Vector3d(a, b, c));
      if (!(handle.condition() < 19))
        continue;
      Force_renderer renderer(limits, {stiffness, 0}, Gravity_compensation::none, tick, needed);
      const Vector3d wanted = random_vector(random, 0.01); // the motors have room
      const double share = renderer.render(handle, wanted).force.norm() / wanted.norm();
      const Eigen::JacobiSVD<Eigen::Matrix3d> svd(handle.jacobian().linear);
      const double friction = 0.005 / std::pow(svd.singularValues()[0], 2),
                   fading = fading_by_condition(limits, handle.condition());
      BOOST_TEST(share * stiffness <= passive_stiffness(friction, 0, tick, 0) * (1 + 1e-9));
      BOOST_TEST(std::abs(share - std::fmin(fading, friction / needed)) <= 1e-9);
      scaled += share < fading, whole += share == fading || share > 1 - 1e-12;
    }
  }
  BOOST_TEST(scaled > 50);
  BOOST_TEST(whole > 50);
}

BOOST_AUTO_TEST_CASE(parameters_that_no_force_can_have_are_refused) {
  const auto refuses = [](const Force_limits& limits, const Virtual_coupling& coupling, double tick) {
    BOOST_CHECK_THROW(Force_renderer(limits, coupling, Gravity_compensation::none, tick), Error);
  };
  for (const double bad : {std::nan(""), -1.0, std::numeric_limits<double>::infinity()}) {
    for (double Force_limits::*member :
         {&Force_limits::largest, &Force_limits::slew, &Force_limits::full_condition, &Force_limits::no_condition,
          &Force_limits::ramp_time, &Force_limits::fade_time}) {
      Force_limits limits;
      limits.*member = bad;
      refuses(limits, Virtual_coupling(), 0.001);
    }
    refuses(Force_limits(), {bad, 0}, 0.001);
    refuses(Force_limits(), {500, bad}, 0.001);
    refuses(Force_limits(), Virtual_coupling(), bad);
  }
  refuses(Force_limits(), Virtual_coupling(), 0);
}

BOOST_AUTO_TEST_CASE(what_is_no_force_is_none_and_said) {
  const Device_parameters<double> parameters = device(Device_form::ditetrahedral, 0.005);
  const Handle_motion handle = handle_at(parameters, Vector3d(1, 1.1, 0.9));
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Force_renderer renderer(Force_limits(), Virtual_coupling(), Gravity_compensation::spatial, 0.001);
    renderer.refuse(handle, Vector3d(1, 0, 0));
    renderer.cut_burst();
    BOOST_TEST(renderer.render(handle, Vector3d::Zero()).force == Vector3d::Zero());
    renderer.render(handle, Vector3d(0, 0, 1));
    const Rendered_force made = renderer.render(handle, Vector3d(0, bad, 1));
    BOOST_TEST(!made.is_finite);
    BOOST_TEST(made.force == Vector3d::Zero());
    BOOST_TEST(made.torque == Vector3d::Zero());
    BOOST_TEST(renderer.fade_out().torque == Vector3d::Zero());
  }
}

BOOST_AUTO_TEST_CASE(after_a_fault_the_weight_is_carried_again_as_slowly_as_forces_come) {
  const Vector3d none = Vector3d::Zero();
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_parameters<double> parameters = device(form, 0.005);
    const Handle_motion handle = handle_at(parameters, Vector3d(1, 1.1, 0.9));
    const Vector3d weight = gravity_torque(parameters, handle.pose(), handle.jacobian());
    Force_renderer renderer(Force_limits(), Virtual_coupling(), Gravity_compensation::spatial, 0.001);
    BOOST_TEST(renderer.render(handle, none).torque == weight);
    renderer.restart(); // without a fault, as in another scene: the hand is not to drop what the motors carry
    BOOST_TEST(renderer.render(handle, none).torque == weight);
    const auto comes_back_from = [&](double left) {
      renderer.restart();
      for (int k = 1; k <= 400; ++k) // the ramp takes 300 ms
        BOOST_TEST((renderer.render(handle, none).torque - std::fmin(1, left + k / 300.0) * weight).norm() <=
                   1e-9 * weight.norm());
    };
    for (const int ticks : {37, 100, 150}) { // the fade takes 100 ms
      for (int k = 0; k < ticks; ++k)
        renderer.fade_out();
      comes_back_from(std::fmax(0, 1 - ticks / 100.0));
    }
    for (int k = 0; k < 50; ++k)
      renderer.fade_out();
    renderer.restart();
    // Another fault at once: half of the weight fades, and the hand does not drop it.
    BOOST_TEST((renderer.fade_out().torque - (0.5 - 0.5 / 100) * weight).norm() <= 1e-9 * weight.norm());
    comes_back_from(0.5 * 0.99);
    renderer.render(handle, Vector3d(0, NAN, 0)); // no torque is left at once
    comes_back_from(0);
    for (int k = 0; k < 200; ++k)
      renderer.fade_out();
    renderer.restart();
    for (int k = 0; k < 150; ++k)
      renderer.render(handle, none); // half of it is back
    for (int k = 0; k < 50; ++k)
      renderer.fade_out();
    comes_back_from(0.25);
  }
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
  slew.cut_to(0.5);
  BOOST_TEST(slew.value() == 0.5 * wanted);
  slew.follow(wanted, 5);
  int ticks = 0;
  while (slew.follow(Vector3d::Zero(), 0.3) != Vector3d::Zero())
    ++ticks;
  BOOST_TEST(ticks <= 17); // |F| / slew = 16.7 ticks, and exactly 0 then
  BOOST_TEST(std::abs(clamped(Vector3d(30, 0, 40), 5).norm() - 5) <= 1e-14);
  BOOST_TEST(clamped(wanted, 5.1) == wanted);
}

BOOST_AUTO_TEST_CASE(a_burst_on_top_of_the_largest_force_is_clamped_too) {
  for (const double rate : {250.0, 1000.0, 10000.0}) {
    Force_limits limits;
    limits.largest = 3;
    Force_chain chain(limits, Virtual_coupling(), 1 / rate);
    const Vector3d wanted(0, 0, 9);
    for (int k = 0; k < rate; ++k)
      chain.follow(wanted, 1, chain.tick());
    chain.refuse(wanted, 1);
    double largest = 0, least = limits.largest;
    for (int k = 0; k < 0.1 * rate; ++k) {
      const double norm = chain.follow(wanted, 1, chain.tick()).norm();
      largest = std::fmax(largest, norm), least = std::fmin(least, norm);
    }
    BOOST_TEST(largest <= limits.largest * (1 + 1e-15));
    BOOST_TEST(least < limits.largest - 0.2); // the burst was there
    chain.refuse(wanted, 1);
    chain.follow(wanted, 1, chain.tick());
    chain.cut_burst();
    BOOST_TEST(std::abs(chain.follow(wanted, 1, chain.tick()).norm() - limits.largest) <= 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(a_fault_fades_to_exactly_nothing_in_its_time) {
  const Device_parameters<double> parameters = device(Device_form::ditetrahedral, 0.005);
  const Handle_motion handle = handle_at(parameters, Vector3d(1, 1.1, 0.9));
  for (const double rate : {250.0, 1000.0, 10000.0}) {
    Force_renderer renderer(Force_limits(), Virtual_coupling(), Gravity_compensation::spatial, 1 / rate);
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

BOOST_AUTO_TEST_CASE(a_fade_ends_in_equal_steps_at_exactly_nothing) {
  Fade_out fade;
  for (int k = 1; k <= 10; ++k) {
    BOOST_TEST(!fade.is_over());
    const double share = fade.next(0.1);
    BOOST_TEST(std::abs(share - (1 - 0.1 * k)) <= 1e-12);
    BOOST_TEST(fade.share() == share);
  }
  BOOST_TEST((fade.is_over() && fade.share() == 0));
  fade.reset();
  BOOST_TEST((!fade.is_over() && fade.share() == 1));
  Slew_limit slew;
  slew.follow(Vector3d(1, 0, 0), 0.5);
  slew.reset();
  BOOST_TEST(slew.value() == Vector3d::Zero());
  Force_limits limits;
  limits.largest = 3, limits.ramp_time = 0.4;
  Force_chain chain(limits, Virtual_coupling(), 0.002);
  BOOST_TEST((chain.limits().largest == 3 && chain.tick() == 0.002));
  BOOST_TEST(std::abs(chain.next_ramp() - 0.005) <= 1e-15);
  chain.follow(Vector3d::Zero(), 0, 0.002);
  BOOST_TEST(std::abs(chain.next_ramp() - 0.01) <= 1e-15);
  BOOST_TEST(std::abs(chain.fade(0.004) - 0.96) <= 1e-12); // of 100 ms
  BOOST_TEST(std::abs(chain.fade(0) - 0.94) <= 1e-12);     // a tick at least
  BOOST_TEST(std::abs(chain.left() - 0.94) <= 1e-12);
  chain.restart();
  BOOST_TEST(chain.left() == 1);
  BOOST_TEST(std::abs(chain.next_ramp() - 0.005) <= 1e-15);
  const Force_renderer renderer(limits, Virtual_coupling(), Gravity_compensation::none, 0.002);
  BOOST_TEST((renderer.limits().largest == 3 && std::abs(renderer.next_ramp() - 0.005) <= 1e-15));
}

} // namespace
