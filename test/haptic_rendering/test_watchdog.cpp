// SPDX-License-Identifier: GPL-3.0-or-later
#include <haptic_sculpt/haptic_rendering/Pose_loop.h>
#include <haptic_sculpt/haptic_rendering/reach_position.h>
#include <haptic_sculpt/haptic_rendering/Watchdog.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

using namespace haptic_sculpt;
using Eigen::Vector3d;

namespace {

BOOST_AUTO_TEST_CASE(a_watchdog_sees_each_fault_and_nothing_else) {
  Watchdog dog(Watchdog_limits(), 0.001, 0.2);
  Joint_reading reading;
  reading.elapsed = 0.001;
  for (int k = 0; k < 1000; ++k) { // 50 rad/s
    reading.theta[k % 3] += k % 2 == 0 ? 0.05 : -0.05;
    BOOST_TEST(dog.check(reading));
    BOOST_TEST(dog.check_condition(19));
  }
  const auto fault = [&](const Joint_reading& bad) {
    Watchdog fresh(Watchdog_limits(), 0.001, 0.2);
    fresh.check(reading);
    BOOST_TEST(!fresh.check(bad));
    BOOST_TEST(!fresh.check(reading)); // it stays
    return fresh.fault();
  };
  Joint_reading bad = reading;
  bad.theta[1] = NAN;
  BOOST_TEST((fault(bad) == Loop_fault::not_finite));
  bad = reading, bad.torque[2] = INFINITY;
  BOOST_TEST((fault(bad) == Loop_fault::not_finite));
  bad = reading, bad.theta[0] += 0.11;
  BOOST_TEST((fault(bad) == Loop_fault::jump));
  bad = reading, bad.elapsed = 0.03;
  BOOST_TEST((fault(bad) == Loop_fault::stall));
  bad = reading, bad.elapsed = 1e-320; // a step over it would be an infinite velocity
  BOOST_TEST((fault(bad) == Loop_fault::clock));
  bad = reading, bad.torque[0] = -0.22;
  BOOST_TEST((fault(bad) == Loop_fault::torque));
  BOOST_TEST(!dog.check_condition(std::numeric_limits<double>::infinity()));
  BOOST_TEST((dog.fault() == Loop_fault::singular));
  dog.reset();
  reading.theta[0] += 1;
  BOOST_TEST(dog.check(reading));
}

BOOST_AUTO_TEST_CASE(the_first_fault_that_is_reported_stays) {
  Watchdog watchdog(Watchdog_limits(), 0.001, 0.2);
  BOOST_TEST(watchdog.limits().stall_time == 0.02);
  watchdog.report(Loop_fault::none);
  BOOST_TEST((watchdog.fault() == Loop_fault::none));
  watchdog.report(Loop_fault::energy), watchdog.report(Loop_fault::log);
  BOOST_TEST((watchdog.fault() == Loop_fault::energy));
  BOOST_TEST(!watchdog.check(Vector3d::Zero(), Vector3d::Zero(), 0.001));
  watchdog.reset();
  BOOST_TEST((watchdog.fault() == Loop_fault::none));
  BOOST_TEST(watchdog.check(Vector3d::Zero(), Vector3d::Zero(), 0.001));
}

// The device has let go by its own timeout by then.
BOOST_AUTO_TEST_CASE(a_stall_while_a_force_fades_ends_it) {
  const Haptic_parameters parameters = Pose_loop_parameters(5).checked();
  Interaction<Pose_side> loop(Pose_side(Pose_device(5), parameters), parameters, 0);
  Pose_reading reading;
  reading.elapsed = parameters.tick;
  Touch touch;
  for (int k = 0; k < 1000; ++k) {
    if (k == 500) // the ramp is over: the spring is whole at once
      touch.way = Vector3d(0.003, 0, 0), touch.is_free = false;
    BOOST_REQUIRE(loop.follow(reading));
    loop.render(touch), loop.end_tick();
  }
  loop.report(Loop_fault::log), loop.end_tick();
  const double left = loop.rendered().force.norm();
  BOOST_TEST(left > 0.1);
  loop.let_pass(0.019), loop.end_tick();
  BOOST_TEST(loop.rendered().force.norm() > 0.9 * left);
  loop.let_pass(0.021), loop.end_tick();
  BOOST_TEST(loop.rendered().force == Vector3d::Zero());
  BOOST_TEST(loop.has_faded());
}

// It has let go by then, too; a fault that is known and has not been told makes no difference.
BOOST_AUTO_TEST_CASE(after_a_stall_a_restart_brings_the_weight_back_slowly) {
  const Device_parameters<double> device(named_design<double>(Named_design::D1, Device_form::ditetrahedral));
  const auto home = home_pose(device);
  const Haptic_parameters parameters;
  for (const bool has_stalled : {false, true})
    for (const bool has_fault : {false, true}) {
      Interaction<Joint_side> loop(Joint_side(device, *home, parameters), parameters, 0);
      Joint_reading reading;
      reading.theta = home->theta;
      for (int k = 0; k < 10; ++k) {
        reading.elapsed = k == 0 ? 7 : parameters.tick; // the first does not count
        BOOST_REQUIRE(loop.follow(reading));
        loop.render(Touch()), loop.end_tick();
      }
      const double weight = loop.rendered().torque.norm();
      BOOST_TEST(weight > 0.01);
      loop.restart();
      if (has_fault)
        loop.report(Loop_fault::error);
      reading.elapsed = has_stalled ? 5 : parameters.tick;
      for (int k = 0; k < 2; ++k) {
        if (loop.follow(reading))
          loop.render(Touch());
        loop.end_tick();
        reading.elapsed = parameters.tick;
        if (has_stalled)
          BOOST_TEST(loop.rendered().torque.norm() < 0.01 * weight);
        else
          BOOST_TEST(loop.rendered().torque.norm() > 0.97 * weight);
      }
    }
}

} // namespace
