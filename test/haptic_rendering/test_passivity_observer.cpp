// SPDX-License-Identifier: GPL-3.0-or-later
// Energy at the motors: counted, and taken back by the controller.
#include "haptic_rendering/devices_of_tests.h"

#include <haptic_sculpt/haptic_rendering/Force_renderer.h>
#include <haptic_sculpt/haptic_rendering/Passivity_controller.h>
#include <haptic_sculpt/haptic_rendering/Passivity_observer.h>
#include <haptic_sculpt/haptic_rendering/loop/Interaction.h>
#include <haptic_sculpt/haptic_rendering/loop/Pose_side.h>
#include <haptic_sculpt/haptic_rendering/simulation/Simulated_device.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

using namespace haptic_sculpt;
using namespace haptic_rendering_tests;

namespace {

BOOST_AUTO_TEST_CASE(the_friction_of_a_joint_that_is_known_by_counts_is_that_of_its_rate) {
  constexpr double tick = 1e-4, friction = 0.005, count = 1.53e-4;
  constexpr int ticks = 20000;
  for (const double rate : {0.1, 1.0, 10.0}) { // rad/s: a count in 15 ticks, two in three, some in each
    Passivity_observer observer(0, tick, friction, count);
    double seen = 0;
    for (int k = 1; k <= ticks; ++k) {
      const double now = count * std::round(rate * tick * k / count);
      observer.add_step(Vector3d(0, now - seen, 0), 0, Vector3d::Zero());
      seen = now;
    }
    const double taken = friction * rate * rate * tick * ticks;
    BOOST_TEST(observer.dissipated() / taken > 0.95);
    BOOST_TEST(observer.dissipated() / taken < 1.15); // two counts in three ticks: of 1 and 2 ticks in turn
  }
}

BOOST_AUTO_TEST_CASE(the_credit_for_counts_is_what_they_hide_however_fast_the_handle_is) {
  constexpr double tick = 0.001, stiffness = 500, count = 1e-5; // s, N/m, m
  constexpr int ticks = 20000;
  for (const double amplitude : {5e-5, 2e-4, 2e-3, 2e-2}) { // m: from less than a count a tick to some hundred
    Passivity_observer observer(0, tick, 0, count);
    double energy = 0, way = 0, last = 0, last_seen = 0, force = 0;
    for (int k = 0; k < ticks; ++k) {
      const double now = amplitude * std::sin(0.0137 * k + 0.3 * std::sin(0.00731 * k)),
                   seen = count * std::round(now / count);
      energy -= force * (now - last), way += (now - last) * (now - last);
      observer.add_step(Vector3d(0, 0, seen - last_seen), stiffness, Vector3d(0, 0, seen - last_seen));
      force = -stiffness * seen;
      observer.command(Vector3d(0, 0, force));
      last = now, last_seen = seen;
    }
    const double hidden = energy - observer.port(), credited = observer.energy() - observer.port();
    // Counts that are off by chance are worth as much in one direction as in the other; and the ends of the motion.
    const double chance = stiffness * count * (2 * std::sqrt(way / 12) + 4 * count);
    BOOST_TEST_MESSAGE(amplitude << " m: hidden " << hidden << ", credited " << credited << ", chance " << chance);
    BOOST_TEST(hidden > 0);
    BOOST_TEST(std::abs(credited - hidden) <= 0.1 * hidden + chance);
    BOOST_TEST(credited <= stiffness * count * count / 2 * ticks);
  }
}

BOOST_AUTO_TEST_CASE(friction_takes_the_same_of_a_motion_whatever_its_ticks_truly_take) {
  constexpr double friction = 2, speed = 0.1; // N s/m, m/s
  Random random(haptic_sculpt::test::seed_from_environment(31));
  std::uniform_real_distribution<double> uneven(0.0006, 0.0014), late(0.0013, 0.0014); // s; declared is 1 ms
  for (auto* elapsed : {&uneven, &late}) {
    const Haptic_parameters parameters;
    Interaction<Pose_side> loop(Pose_side(Pose_device(friction), parameters), parameters, 0);
    Pose_reading reading;
    reading.elapsed = 1e9; // does not count at the first
    double time = 0;
    for (int k = 0; k < 2000; ++k) {
      BOOST_REQUIRE(loop.follow(reading));
      loop.render(Touch()), loop.end_tick();
      reading.elapsed = (*elapsed)(random);
      reading.position[0] += speed * reading.elapsed;
      time += k + 1 < 2000 ? reading.elapsed : 0;
    }
    BOOST_TEST(std::abs(loop.observer().dissipated() / (friction * speed * speed * time) - 1) <= 1e-9); // rounding
  }
  Passivity_observer hasty(0, 0.001, friction, 0); // two readings at all but one time: no friction beyond all measure
  hasty.add_step(Vector3d(0.001, 0, 0), 0, Vector3d::Zero(), 1e-12);
  BOOST_TEST(std::abs(hasty.dissipated() / (friction * 1e-6 / 0.0005) - 1) <= 1e-12);
}

BOOST_AUTO_TEST_CASE(a_controller_damps_the_true_velocity_and_takes_no_more_than_is_missing_in_a_tick_as_long) {
  constexpr double tick = 0.001, missing = 0.01; // s, J
  Passivity_observer observer(0, tick, 0, 0);
  observer.command(Vector3d(0, 0, 1));
  observer.add_step(Vector3d(0, 0, missing), 0, Vector3d(0, 0, missing)); // given to the hand
  const Vector3d velocity(0, 0, 0.1);                                    // m/s
  for (const double elapsed : {0.0005, 0.001, 0.002, 0.01}) {
    Passivity_controller weak(3, tick), strong(1e5, tick);
    BOOST_TEST((weak.force(observer, velocity * elapsed, elapsed) + 3 * velocity).norm() <= 1e-12);
    const Vector3d force = strong.force(observer, velocity * elapsed, elapsed);
    BOOST_TEST(-force.dot(velocity) * std::max(tick, elapsed) <= missing * (1 + 1e-12));
    BOOST_TEST(-force.dot(velocity) * std::max(tick, elapsed) >= missing * (1 - 1e-12));
  }
  Passivity_controller hasty(3, tick); // two readings at all but one time: no speed beyond all measure
  BOOST_TEST((hasty.force(observer, 0.1 * tick * velocity, 1e-12) + 3 * 0.2 * velocity).norm() <= 1e-12);
}

BOOST_AUTO_TEST_CASE(a_loop_damps_the_true_velocity_whatever_its_ticks_truly_take) {
  for (const double elapsed : {0.0006, 0.001, 0.0014, 0.002}) { // s; declared is 1 ms
    Haptic_parameters parameters;
    parameters.coupling.stiffness = 100, parameters.limits.ramp_time = 0, parameters.limits.slew = 1e9;
    Interaction<Pose_side> loop(Pose_side(Pose_device(0), parameters), parameters, 3);
    Pose_reading reading;
    const auto tick = [&](double step, double time, double way) {
      reading.position[2] += step, reading.elapsed = time;
      BOOST_REQUIRE(loop.follow(reading));
      Touch touch;
      touch.way[2] = way, touch.is_free = way == 0;
      loop.render(touch), loop.end_tick();
    };
    tick(0, 0.001, 0), tick(0, 0.001, 0.01); // the spring pushes with 1 N, ...
    BOOST_TEST(loop.spring() == Vector3d(0, 0, 1));
    tick(0.001, 0.001, 0); // ... and gives 1 mJ
    tick(0.1 * elapsed, elapsed, 0); // at 0.1 m/s
    BOOST_TEST((loop.wanted() - Vector3d(0, 0, -0.3)).norm() <= 1e-12);
    BOOST_TEST((loop.spring() == Vector3d::Zero() && loop.controller().damping() == 3));
    const Vector3d last = loop.rendered().force;
    loop.report(Loop_fault::log), loop.end_tick(); // found elsewhere
    BOOST_TEST((loop.fault() == Loop_fault::log));
    BOOST_TEST((loop.rendered().force - (1 - elapsed / 0.1) * last).norm() <= 0.01 * last.norm()); // a fade of 100 ms
  }
}

BOOST_AUTO_TEST_CASE(the_observer_counts_the_true_energy_of_the_port) {
  const Hand_path path(
      {{0, {0, 0, 0.132}, 0}, {0.2, {0.01, 0, 0.140}, 0}, {0.5, {-0.01, 0.01, 0.12}, 0}, {1, {0, 0, 0.13}, 0}});
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general})
    for (const double delay : {0.0, 0.3, 1.0, 1.7}) {
      const Device_parameters<double> parameters = device(form, 0.005);
      Handle_motion handle(parameters, *home_pose(parameters), 0.001);
      Simulated_device simulated(parameters, *home_pose(parameters), Simulated_hand::arm(), path, 0.001, delay);
      Passivity_observer observer(delay, 0.001, 0.005, 0);
      Force_renderer renderer(Force_limits(), Virtual_coupling(), Gravity_compensation::spatial, 0.001);
      double worst = 0, turnover = 0;
      for (int k = 0; k < 1000; ++k) {
        handle.follow(simulated.read().theta);
        observer.add_step(handle.joint_step(), 500, handle.step());
        worst = std::max(worst, std::abs(observer.port() - simulated.port()));
        turnover = std::max(turnover, std::abs(simulated.port()));
        const Vector3d wall(0, 0, 500 * std::max(0.0, 0.13 - handle.position()[2]));
        const Rendered_force rendered = renderer.render(handle, wall);
        observer.command(rendered.interaction_torque);
        BOOST_TEST((simulated.write(rendered.torque, rendered.interaction_torque) == Device_status::success));
        BOOST_TEST(simulated.port() + simulated.dissipated() >= -1e-9);
      }
      BOOST_TEST_MESSAGE("delay " << delay << ": observer off by " << worst << " J of " << turnover);
      BOOST_TEST(turnover > 1e-5);
      BOOST_TEST(worst <= (delay == std::floor(delay) ? 1e-12 : 1e-5));
    }
}

/// A hand presses on a plane whose stiffness is a multiple of the passive limit.
struct Pressed {
  double least = 0, buzz = 0, most_damping = 0; ///< J; mean |acceleration| in the second half, m/s^2; N s/m
};
Pressed press(double times, double most_damping) {
  const Device_parameters<double> parameters = device(Device_form::ditetrahedral);
  const auto home = home_pose(parameters);
  const double tick = 0.001, sigma = translation_conditioning(*jacobian(parameters, *home)).greatest;
  const double stiffness = times * 2 * 0.005 / (sigma * sigma) / tick;
  const Hand_path path(
      {{0, home->position + Vector3d(0, 0, 0.002), 0}, {0.2, home->position - Vector3d(0, 0, 0.008), 0}});
  const auto start = reach_position(parameters, *home, path.at(0).position);
  Simulated_device simulated(parameters, *start, Simulated_hand::finger(), path, tick, 0);
  Handle_motion handle(parameters, *start, tick);
  Force_renderer renderer(no_limits(), Virtual_coupling(), Gravity_compensation::spatial, tick);
  Passivity_observer observer(0, tick, 0.005, 0);
  Passivity_controller controller(most_damping, tick);
  Pressed pressed;
  Vector3d last_step = Vector3d::Zero();
  for (int k = 0; k < 1000; ++k) {
    handle.follow(simulated.read().theta);
    observer.add_step(handle.joint_step(), stiffness, handle.step());
    const double depth = home->position[2] - handle.position()[2];
    const Vector3d wall(0, 0, stiffness * std::max(0.0, depth));
    const Rendered_force rendered = renderer.render(handle, wall + controller.force(observer, handle.step()));
    observer.command(rendered.interaction_torque);
    if (simulated.write(rendered.torque, rendered.interaction_torque) != Device_status::success)
      break;
    pressed.least = std::min(pressed.least, simulated.port() + simulated.dissipated());
    pressed.most_damping = std::max(pressed.most_damping, controller.damping());
    if (k >= 500)
      pressed.buzz += (handle.step() - last_step).norm() / tick / tick / 500;
    last_step = handle.step();
  }
  return pressed;
}

BOOST_AUTO_TEST_CASE(a_controller_does_nothing_within_the_limit_and_takes_energy_back_beyond_it) {
  const Pressed passive = press(0.9, 5);
  BOOST_TEST(passive.most_damping == 0);
  BOOST_TEST(passive.least >= -1e-9);
  for (const double times : {7.0, 8.0, 10.0}) {
    const Pressed without = press(times, 0), with = press(times, 10);
    BOOST_TEST_MESSAGE(times << " times the passive limit: least energy " << without.least << " J and " << with.least
                             << " J with a controller; mean acceleration at rest " << without.buzz << " and "
                             << with.buzz << " m/s^2");
    BOOST_TEST(without.least < -1e-2); // it buzzes
    BOOST_TEST(with.least >= 0.02 * without.least);
    BOOST_TEST(with.buzz <= 0.02 * without.buzz);
  }
}

BOOST_AUTO_TEST_CASE(what_a_hand_has_put_in_counts_up_to_what_can_come_back_of_it) {
  Passivity_observer observer(0, 0.001, 0, 0);
  const auto exchange = [&](double energy) { // J, from the hand
    observer.command(Vector3d(0, 0, -1));
    observer.add_step(Vector3d(0, 0, energy), 0, Vector3d::Zero());
  };
  exchange(0.5);
  BOOST_TEST(std::abs(observer.balance() - 0.5) <= 1e-12);
  observer.forget_beyond(0.1);
  BOOST_TEST(std::abs(observer.balance() - 0.1) <= 1e-12);
  observer.forget_beyond(0.3); // what is forgotten stays so
  BOOST_TEST(std::abs(observer.balance() - 0.1) <= 1e-12);
  BOOST_TEST(std::abs(observer.energy() - 0.5) <= 1e-12);
  exchange(-0.104);
  BOOST_TEST(!observer.is_active()); // 4 mJ: allowed for
  exchange(-0.002);
  BOOST_TEST(observer.is_active());
  observer.restart();
  BOOST_TEST((!observer.is_active() && observer.balance() == 0 && observer.energy() == 0));
  exchange(0.99 * Passivity_observer::most_of_a_step / 2); // once as work, once in the balance
  BOOST_TEST(!observer.is_blind());
  exchange(1.01 * Passivity_observer::most_of_a_step / 2);
  BOOST_TEST(observer.is_blind());
  exchange(0.1);
  BOOST_TEST(observer.is_blind()); // until
  observer.restart();
  BOOST_TEST(!observer.is_blind());
  exchange(std::nan(""));
  BOOST_TEST(observer.is_blind());
}

BOOST_AUTO_TEST_CASE(where_no_force_is_wanted_it_goes_by_the_slew_limit_and_a_burst_at_once) {
  Haptic_parameters parameters;
  Interaction<Pose_side> loop(Pose_side(Pose_device(2), parameters), parameters, 0);
  Pose_reading reading;
  reading.elapsed = parameters.tick;
  const auto follow = [&] { BOOST_REQUIRE(loop.follow(reading)); };
  Touch pressed;
  pressed.way = Vector3d(0, 0, 0.001), pressed.is_free = false;
  for (int k = 0; k < 400; ++k) // the ramp
    follow(), loop.render(Touch()), loop.end_tick();
  for (int k = 0; k < 100; ++k)
    follow(), loop.render(pressed), loop.end_tick();
  loop.refuse(Vector3d(1, 0, 0));
  follow(), loop.render(pressed), loop.end_tick();
  double before = loop.rendered().force[2];
  BOOST_TEST(before > 0.1);
  while (before > 0) {
    follow(), loop.render_nothing(), loop.end_tick();
    const Vector3d force = loop.rendered().force;
    BOOST_REQUIRE((force[0] == 0 && force[1] == 0 && force[2] < before));
    BOOST_REQUIRE(before - force[2] <= parameters.limits.slew * parameters.tick * (1 + 1e-12));
    before = force[2];
  }
  BOOST_TEST((loop.spring() == Vector3d::Zero() && loop.wanted() == Vector3d::Zero()));
}

} // namespace
