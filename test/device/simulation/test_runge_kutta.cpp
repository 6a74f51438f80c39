// SPDX-License-Identifier: GPL-3.0-or-later
// The mechanism in a hand that moves along: against another formulation, energy, and long double.
#include "device/simulation/coupled_hand.h"
#include "device/maximal_coordinates.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

BOOST_AUTO_TEST_SUITE(device_simulation)

BOOST_AUTO_TEST_CASE(the_coupled_step_is_of_fourth_order_and_solves_the_equations_of_another_formulation) {
  for (Device_form form : both_forms) {
    const Device_parameters<double> parameters(with_friction(named_design<double>(Named_design::D1, form), 2e-4, 1e-4));
    const Vector theta(1.0, 1.1, 0.95);
    Hand<double, 6> hand{parameters, forward_kinematics(parameters, theta)->position};
    hand.grip_stiffness = 100, hand.grip_damping = 0.5; // a loose grip
    const Coupled_state<double, 6> start = [&] {
      Coupled_state<double, 6> s = at_rest<double, 6>(parameters, theta);
      // No joint stops on the way: there Coulomb friction turns over faster than coarse steps resolve.
      s.device.rate = Vector(4, 3.5, 3);
      return s;
    }();
    const double length = 0.008;
    const auto end = [&](int steps) {
      Coupled_state<double, 6> state = start;
      for (int k = 0; k < steps; ++k)
        state = *runge_kutta_step(parameters, Dynamics_model::spatial, state, k * length / steps, length / steps, hand);
      return state;
    };
    // The same by seven bodies with multipliers, midpoint steps extrapolated twice (fourth order), place of the hand
    // included.
    const auto slope = [&](const Eigen::Matrix<double, 12, 1>& x, double time) {
      const auto pose = forward_kinematics(parameters, Vector(x.head<3>()), start.device.pose);
      const auto motion = device_motion(parameters, *pose, Vector(x.segment<3>(3)));
      const auto effect = hand(*motion, Eigen::Matrix<double, 6, 1>(x.tail<6>()), time);
      const Vector rate = x.segment<3>(3);
      Vector torque = effect.torque;
      for (int joint = 0; joint < 3; ++joint)
        torque[joint] -= 2e-4 * rate[joint] + 1e-4 * std::tanh(50 * rate[joint]);
      Eigen::Matrix<double, 12, 1> s;
      s << rate, maximal_coordinates::joint_accelerations(parameters, *pose, rate, torque), effect.further_rate;
      return s;
    };
    const auto reference = [&](int steps) {
      Eigen::Matrix<double, 12, 1> x;
      x << theta, start.device.rate, start.further;
      for (int k = 0; k < steps; ++k) {
        const double h = length / steps, t = k * h;
        const auto half = Eigen::Matrix<double, 12, 1>(x + h / 2 * slope(x, t));
        x += h * slope(half, t + h / 2);
      }
      return x;
    };
    // Midpoint errors have all powers from the second on; two extrapolations take the second and third.
    const auto a = reference(40), b = reference(80), c = reference(160);
    const Eigen::Matrix<double, 12, 1> ab = b + (b - a) / 3, bc = c + (c - b) / 3, truth = bc + (bc - ab) / 7;
    const auto distance = [&](const Coupled_state<double, 6>& s) {
      Eigen::Matrix<double, 12, 1> x;
      x << s.device.pose.theta, s.device.rate, s.further;
      return (x - truth).norm();
    };
    const auto best = end(128);
    const auto error = [&](int steps) {
      const auto s = end(steps);
      return (s.device.pose.theta - best.device.pose.theta).norm() + (s.device.rate - best.device.rate).norm() +
             (s.further - best.further).norm();
    };
    const double order = std::log2(error(8) / error(16));
    BOOST_TEST_MESSAGE((form == Device_form::general ? "general" : "di-tetrahedral")
                       << ": order " << order << ", differs from seven bodies by " << distance(best));
    BOOST_TEST(order > 3.6);
    BOOST_TEST(order < 4.6);
    BOOST_TEST(distance(best) < 1e-9);
    BOOST_TEST((best.device.rate - start.device.rate).norm() > 0.1); // something happened
    BOOST_TEST(best.device.rate.minCoeff() > 0.5);                   // and no joint came to rest
  }
}

BOOST_AUTO_TEST_CASE(energy_is_accounted_for_with_friction_a_hand_and_gravity_compensation) {
  for (Device_form form : both_forms) {
    const Device_parameters<double> parameters(with_friction(named_design<double>(Named_design::D1, form), 5e-4, 1e-3));
    const Vector theta(1.0, 1.1, 0.95);
    Coupled_state<double, 10> state = at_rest<double, 10>(parameters, theta);
    const Hand<double, 10> hand{parameters, state.device.pose.position};
    const auto energy = [&] {
      const auto terms = dynamics(parameters, Dynamics_model::spatial, state.device.pose, state.device.rate);
      return terms->kinetic + terms->potential + 0.5 * hand.mass * state.further.segment<3>(3).squaredNorm();
    };
    const double before = energy();
    double worst = 0, dissipated = 0;
    for (int k = 0; k < 2000; ++k) {
      state = *runge_kutta_step(parameters, Dynamics_model::spatial, state, k * 5e-4, 5e-4, hand);
      BOOST_REQUIRE(state.further[7] <= dissipated); // friction never gives back
      dissipated = state.further[7];
      // What the path, friction and the motors have put in; the grip's spring and damper have taken the rest.
      worst = std::max(worst, std::abs(energy() - before -
                                       (state.further[6] + state.further[7] + state.further[8] + state.further[9])));
    }
    BOOST_TEST_MESSAGE((form == Device_form::general ? "general" : "di-tetrahedral")
                       << ": path " << state.further[6] << " J, friction " << dissipated << " J, unaccounted at most "
                       << worst << " J in one second");
    BOOST_TEST(dissipated < -1e-4);
    BOOST_TEST(worst < 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(double_follows_long_double) {
  for (Device_form form : both_forms) {
    const Device_description<double> design = with_friction(named_design<double>(Named_design::D1, form), 5e-4, 1e-3);
    const Device_parameters<double> parameters(design);
    const Device_parameters<Long> fine(description_as<Long>(design));
    const Vector theta(1.0, 1.1, 0.95);
    auto state = at_rest<double, 10>(parameters, theta);
    auto exact = at_rest<Long, 10>(fine, vector_as<Long>(theta));
    const Hand<double, 10> hand{parameters, state.device.pose.position};
    Hand<Long, 10> fine_hand{fine, vector_as<Long>(state.device.pose.position)};
    fine_hand.mass = 1.46, fine_hand.arm_stiffness = 48.8, fine_hand.arm_damping = 4.5, fine_hand.grip_damping = 7.9;
    for (int k = 0; k < 500; ++k) {
      state = *runge_kutta_step(parameters, Dynamics_model::spatial, state, k * 0.0009765625, 0.0009765625, hand);
      exact = *runge_kutta_step(fine, Dynamics_model::spatial, exact, k * 0.0009765625L, 0.0009765625L, fine_hand);
    }
    const double off =
        (exact.device.pose.position.cast<double>() - state.device.pose.position).norm() / design.secondary_length;
    BOOST_TEST_MESSAGE((form == Device_form::general ? "general" : "di-tetrahedral")
                       << ": after 500 steps double is off by " << off << " of l2");
    BOOST_TEST(off < 1e-12);
  }
}

BOOST_AUTO_TEST_SUITE_END()
