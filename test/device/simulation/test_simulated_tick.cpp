// SPDX-License-Identifier: GPL-3.0-or-later
// Whole ticks. Allocations are counted: Eigen's by its own switch, all others by operator new.
#include "../examples/count_allocations.h"
#include "device/simulation/coupled_hand.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

BOOST_AUTO_TEST_SUITE(device_simulation)

BOOST_AUTO_TEST_CASE(two_substeps_a_tick_are_as_good_as_forty) {
  BOOST_TEST_MESSAGE("seed " << seed + 3);
  Random random(seed + 3);
  double worst = 0;
  for (Device_form form : both_forms)
    for (double delay : {0.0, 0.25, 0.6, 1.0, 1.75}) {
      const Device_parameters<double> parameters(
          with_friction(named_design<double>(Named_design::D1, form), 2e-4, 1e-3));
      auto coarse = at_rest<double, 6>(parameters, Vector(1.0, 1.1, 0.95)), fine = coarse;
      Hand<double, 6> hand{parameters, coarse.device.pose.position};
      hand.arm_stiffness = 2000, hand.arm_damping = 60; // a firm arm: up to 8 rad/s at the joints
      Torque_delay<double> held(delay), held_fine(delay);
      const auto torque = [&](const Coupled_state<double, 6>& state,
                              const Vector& wall) { // a stiff wall
        const auto map = jacobian(parameters, state.device.pose);
        const double depth = wall.dot(state.device.pose.position - hand.centre);
        const Vector force = depth > 0 ? Vector(-600 * depth * wall) : Vector(Vector::Zero());
        return Vector(map->torque(force, Vector::Zero()) + gravity_torque(parameters, state.device.pose, *map));
      };
      const Vector wall = random_vector(random, 1).normalized();
      double farthest = 0;
      for (int tick = 0; tick < 300; ++tick) {
        held.command(torque(coarse, wall)), held_fine.command(torque(fine, wall));
        const auto next = simulate_tick(parameters, Dynamics_model::spatial, coarse, tick * 1e-3, 1e-3, held, hand);
        const auto next_fine =
            simulate_tick(parameters, Dynamics_model::spatial, fine, tick * 1e-3, 1e-3, held_fine, hand, 40);
        BOOST_REQUIRE((next && next_fine));
        coarse = *next, fine = *next_fine;
        farthest = std::max(farthest, (coarse.device.pose.position - hand.centre).norm());
        worst = std::max(worst, (coarse.device.pose.position - fine.device.pose.position).norm());
      }
      BOOST_TEST(farthest > 1e-2);
    }
  BOOST_TEST_MESSAGE("at 1 kHz with Coulomb friction, 10 runs of 300 ticks: two substeps differ from forty by at most "
                     << worst << " m");
  BOOST_TEST(worst < 9e-7);
}

BOOST_AUTO_TEST_CASE(a_tick_is_split_where_the_torque_changes) {
  const Device_parameters<double> parameters(named_design<double>(Named_design::D1, Device_form::ditetrahedral));
  const auto start = at_rest<double, 6>(parameters, Vector(1.0, 1.1, 0.95));
  const Hand<double, 6> hand{parameters, start.device.pose.position};
  const Vector old_torque(0.05, -0.02, 0.01), new_torque(-0.03, 0.04, 0.02);
  for (double delay : {0.0, 0.3, 0.5, 0.97}) {
    Torque_delay<double> held(delay);
    held.command(old_torque), held.command(new_torque);
    const auto got = simulate_tick(parameters, Dynamics_model::spatial, start, 0.0, 1e-3, held, hand, 20);
    Coupled_state<double, 6> state = start; // the same by hand, one part after the other
    const auto under = [&](const Vector& torque, double from, double length) {
      for (int k = 0; k < 50 && length > 0; ++k)
        state =
            *runge_kutta_step(parameters, Dynamics_model::spatial, state, from + k * length / 50, length / 50,
                              [&](const Device_motion<double>& motion, const Further_states<double, 6>& y, double now) {
                                auto effect = hand(motion, y, now);
                                effect.torque += torque;
                                return effect;
                              });
    };
    under(old_torque, 0, delay * 1e-3);
    under(new_torque, delay * 1e-3, (1 - delay) * 1e-3);
    BOOST_TEST((got->device.rate - state.device.rate).norm() < 1e-9);
    BOOST_TEST((got->further - state.further).norm() < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(failures_are_results_and_leave_the_state_alone) {
  const Device_parameters<double> parameters(named_design<double>(Named_design::D1, Device_form::ditetrahedral));
  const auto start = at_rest<double, 6>(parameters, Vector(1.0, 1.1, 0.95));
  const auto with = [](double torque, double slope) {
    return [=](const Device_motion<double>&, const Further_states<double, 6>&, double) {
      return Surroundings_effect<double, 6>{Vector::Constant(torque), Further_states<double, 6>::Constant(slope)};
    };
  };
  BOOST_TEST((runge_kutta_step(parameters, Dynamics_model::spatial, start, 0.0, 1e-3, with(std::nan(""), 0)).status() ==
              Device_status::not_finite));
  BOOST_TEST((runge_kutta_step(parameters, Dynamics_model::spatial, start, 0.0, 1e-3, with(0, HUGE_VAL)).status() ==
              Device_status::not_finite));
  int unreachable = 0; // where a step of seconds would end is chance
  for (double seconds = 1; seconds <= 20; ++seconds)
    unreachable += runge_kutta_step(parameters, Dynamics_model::spatial, start, 0.0, seconds, with(0.2, 0)).status() !=
                   Device_status::success;
  BOOST_TEST(unreachable > 0);
  Torque_delay<double> held(0.5);
  BOOST_TEST(
      (simulate_tick(parameters, Dynamics_model::spatial, start, 0.0, 1e-3, held, with(0, std::nan(""))).status() ==
       Device_status::not_finite));
  const auto weightless = [] {
    Device_description<double> d;
    d.primary_mass = d.secondary_mass = d.platform_mass = 0;
    d.platform_inertia.setZero();
    return Device_parameters<double>(d);
  }();
  BOOST_TEST((forward_dynamics(weightless, Dynamics_model::spatial, start.device.pose, Vector(Vector::Zero()),
                               Vector(0.1, 0, 0))
                  .status() == Device_status::singular));
}

BOOST_AUTO_TEST_CASE(nothing_is_allocated) {
  for (Device_form form : both_forms) {
    Device_description<double> d = with_friction(named_design<double>(Named_design::D1, form), 5e-4, 1e-3);
    d.encoder_step = 1.53e-4;
    const Device_parameters<double> parameters(d);
    auto state = at_rest<double, 10>(parameters, Vector(1.0, 1.1, 0.95));
    const Hand<double, 10> hand{parameters, state.device.pose.position};
    Torque_delay<double> held(0.7);
    Device_pose<double> seen = state.device.pose;
    double sum = 0;
    bool good = true;
    const std::size_t before = allocations_so_far;
    Eigen::internal::set_is_malloc_allowed(false);
    for (int tick = 0; tick < 100 && good; ++tick) {
      const auto pose = forward_kinematics(parameters, measured_angles(parameters, state.device.pose.theta), seen);
      good = static_cast<bool>(pose);
      seen = *pose;
      const auto map = jacobian(parameters, seen);
      sum += translation_conditioning(*map).condition;
      held.command(Vector(gravity_torque(parameters, seen, *map) + joint_friction(parameters, state.device.rate)));
      const auto next = simulate_tick(parameters, Dynamics_model::spatial, state, tick * 1e-3, 1e-3, held, hand);
      good = good && next;
      state = *next;
    }
    Eigen::internal::set_is_malloc_allowed(true);
    BOOST_TEST(good);
    BOOST_TEST(allocations_so_far == before);
    BOOST_TEST(sum > 100);
  }
}

BOOST_AUTO_TEST_SUITE_END()
