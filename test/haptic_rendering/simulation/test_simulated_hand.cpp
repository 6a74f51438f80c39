// SPDX-License-Identifier: GPL-3.0-or-later
// The hand of the simulated device: the path that it wants to go, and where it rests.
#include "haptic_rendering/devices_of_tests.h"

#include <haptic_sculpt/haptic_rendering/Force_renderer.h>
#include <haptic_sculpt/haptic_rendering/simulation/Hand_path.h>
#include <haptic_sculpt/haptic_rendering/simulation/Simulated_device.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <cfenv>
#include <cmath>
#include <string>

using namespace haptic_sculpt;
using namespace haptic_rendering_tests;

namespace {

BOOST_AUTO_TEST_CASE(paths_are_read_or_refused_by_line_and_column) {
  const Hand_path path = Hand_path::parse("t,x,y,z,button\n0,0,0,0.1,0\r\n1,1e-2,-0.02,0.1,1\n", "p");
  BOOST_TEST((path.at(0.25).position - Vector3d(0.0025, -0.005, 0.1)).norm() <= 1e-17);
  BOOST_TEST((path.at(0.25).velocity - Vector3d(0.01, -0.02, 0)).norm() <= 1e-17);
  BOOST_TEST(path.at(0.99).button == 0);
  BOOST_TEST(path.at(1).button == 1);
  BOOST_TEST(path.at(7).velocity == Vector3d::Zero());
  std::fesetround(FE_UPWARD); // a caller's
  BOOST_TEST((Hand_path::parse("t,x,y,z,button\n0,0.1,1e-2,0.3,0\n", "p").at(0).position == Vector3d(0.1, 1e-2, 0.3)));
  std::fesetround(FE_TONEAREST);
  const auto refused = [](const char* text, const char* where) {
    try {
      Hand_path::parse(text, "p");
      BOOST_ERROR("not refused: " << text);
    } catch (const Hand_path_error& error) {
      BOOST_TEST(std::string(error.what()).find(where) != std::string::npos, error.what() << " does not say " << where);
    }
  };
  refused("", "p: line 1");
  refused("t,x,y,z\n0,0,0,0\n", "line 1, column 1");
  refused("t,x,y,z,button\n", "line 2");
  refused("t,x,y,z,button\n0,0,zero,0,0\n", "line 2, column 5");
  refused("t,x,y,z,button\n0,0,nan,0,0\n", "line 2, column 5");
  refused("t,x,y,z,button\n0,0,0,0\n", "line 2, column 8");
  refused("t,x,y,z,button\n0,0,0,0,0,0\n", "line 2, column 10");
  refused("t,x,y,z,button\n0,0,0,0,3\n", "line 2");
  refused("t,x,y,z,button\n0,0,0,0,0\n0,0,0,0,0\n", "line 3");
  Hand_path::parse("t,x,y,z,button\n0.478130166,0,0,0,0\n0.478130167,0,0,0,0\n", "p"); // rounded, 9.999999717e-10 s
}

BOOST_AUTO_TEST_CASE(what_is_read_gives_finite_places_and_velocities) {
  const auto reads = [](const std::string& rows) {
    try {
      const Hand_path path = Hand_path::parse("t,x,y,z,button\n" + rows, "p");
      for (const double time : {path.rows().front().time, path.rows()[1].time, path.end()})
        BOOST_TEST((path.at(time).position.allFinite() && path.at(time).velocity.allFinite()));
      return true;
    } catch (const Hand_path_error&) {
      return false;
    }
  };
  BOOST_TEST(reads("0,-1e9,1e9,0,0\n1e-9,1e9,-1e9,0,0\n1e9,0,0,0,0\n"));
  BOOST_TEST(!reads("0,-1e308,0,0,0\n1,1e308,0,0,0\n"));
  BOOST_TEST(!reads("-1e308,0,0,0,0\n1e308,0,0,0,0\n"));
  BOOST_TEST(!reads("0,0,0,0,0\n1e-320,1,0,0,0\n"));
}

BOOST_AUTO_TEST_CASE(a_hand_comes_to_rest_where_it_wants_to_be) {
  const Hand_path path({{0, {0.004, 0.002, 0.136}, 0}});
  for (const Simulated_hand& hand : {Simulated_hand::finger(), Simulated_hand::arm()}) {
    const Device_parameters<double> parameters = device(Device_form::ditetrahedral, 0.005);
    Simulated_device simulated(parameters, *home_pose(parameters), hand, path, 0.001, 0);
    Handle_motion handle(parameters, *home_pose(parameters), 0.001);
    Force_renderer renderer(Force_limits(), Virtual_coupling(), Gravity_compensation::spatial, 0.001);
    for (int k = 0; k < 3000; ++k) {
      handle.follow(simulated.read().theta);
      const Rendered_force rendered = renderer.render(handle, Vector3d::Zero());
      simulated.write(rendered.torque, rendered.interaction_torque);
    }
    BOOST_TEST((simulated.state().pose.position - path.at(0).position).norm() <= 1e-4);
  }
}

BOOST_AUTO_TEST_CASE(torques_that_are_not_finite_are_refused_and_forgotten) {
  const Hand_path path({{0, {0.004, 0.002, 0.136}, 0}});
  const Device_parameters<double> parameters = device(Device_form::ditetrahedral, 0.005);
  const Simulated_hand hand = Simulated_hand::finger();
  Simulated_device tried(parameters, *home_pose(parameters), hand, path, 0.001, 1),
      other(parameters, *home_pose(parameters), hand, path, 0.001, 1);
  const Vector3d torque(0.01, 0, 0), bad(0, std::nan(""), 0);
  for (int k = 0; k < 5; ++k) {
    BOOST_TEST((tried.write(bad, torque) == Device_status::not_finite));
    BOOST_TEST((tried.write(torque, bad) == Device_status::not_finite));
    BOOST_TEST((tried.write(torque, torque) == Device_status::success));
    other.write(torque, torque);
    BOOST_TEST((tried.read().theta == other.read().theta && tried.read().torque == other.read().torque));
  }
}

/// Energy of all springs and masses of a hand but the first mass, J.
double energy_of(const Simulated_hand& hand, const Simulated_hand::States& states, const Vector3d& handle,
                 const Vector3d& wish) {
  double sum = 0;
  for (int i = 0; i < hand.stages; ++i) {
    const Vector3d here = i == 0 ? handle : Vector3d(states.segment<3>(6 * i - 6)),
                   next = i + 1 == hand.stages ? wish : Vector3d(states.segment<3>(6 * i));
    sum += hand.stage[i].stiffness * (next - here).squaredNorm() / 2;
    if (i > 0)
      sum += hand.stage[i].mass * states.segment<3>(6 * i - 3).squaredNorm() / 2;
  }
  return sum;
}

BOOST_AUTO_TEST_CASE(a_hand_gives_what_its_springs_and_masses_lose_and_its_dampers_take) {
  Random random(haptic_sculpt::test::seed_from_environment(63));
  Simulated_hand three = Simulated_hand::arm();
  three.stages = 3, three.stage[2] = {0.4, 90, 4};
  for (const Simulated_hand& hand : {*Simulated_hand::named("finger"), *Simulated_hand::named("arm"),
                                     *Simulated_hand::named("measured_arm"), three}) {
    const Vector3d place = random_vector(random, 1);
    BOOST_TEST(hand.effect(hand.at_rest(place), place, Vector3d::Zero(), place, Vector3d::Zero()).force ==
               Vector3d::Zero());
    BOOST_TEST(hand.effect(hand.at_rest(place), place, Vector3d::Zero(), place, Vector3d::Zero()).rates.norm() == 0);
    for (int i = 0; i < 50; ++i) {
      Simulated_hand::States states = Simulated_hand::States::Zero();
      for (int k = 0; k < 6 * (hand.stages - 1); k += 3)
        states.segment<3>(k) = random_vector(random, 0.1);
      const Vector3d handle = random_vector(random, 0.1), handle_velocity = random_vector(random, 1),
                     wish = random_vector(random, 0.1);
      const auto effect = hand.effect(states, handle, handle_velocity, wish, Vector3d::Zero());
      // A wish that stands still puts nothing in: what goes to the handle is what is lost, less what dampers take.
      const double h = 1e-6;
      const auto energy_after = [&](double time) {
        return energy_of(hand, states + time * effect.rates, handle + time * handle_velocity, wish);
      };
      const double lost = -(energy_after(h) - energy_after(-h)) / (2 * h);
      const double given = effect.force.dot(handle_velocity);
      BOOST_TEST(std::abs(given - (lost - effect.dissipated)) <= 1e-6 * (1 + std::abs(lost)));
      BOOST_TEST(effect.dissipated >= 0);
    }
  }
  BOOST_TEST(Simulated_hand::named("finger")->stage[0].stiffness == 300);
  BOOST_TEST(Simulated_hand::named("measured_arm")->stage[0].mass == 0.554);
  BOOST_TEST(Simulated_hand::named("arm")->stages == 2);
  BOOST_TEST(!Simulated_hand::named("Finger"));
}

// A tick is several steps, and the torque may change within it.
BOOST_AUTO_TEST_CASE(a_device_stays_where_it_is_in_a_tick_in_which_it_cannot_move_on) {
  const Hand_path path({{0, {0.004, 0.002, 0.136}, 0}});
  std::size_t failed = 0;
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general})
    for (const double delay : {0.0, 0.3, 0.8})
      for (const double torque : {1.0, -1.0}) {
        const Device_parameters<double> parameters = device(form, 0.005);
        Simulated_device simulated(parameters, *home_pose(parameters), Simulated_hand::finger(), path, 0.005, delay);
        for (int k = 0; k < 50; ++k) {
          const Device_state<double> before = simulated.state();
          const double port = simulated.port(), dissipated = simulated.dissipated();
          const Vector3d all(torque, torque, torque);
          if (simulated.write(all, all) == Device_status::success)
            continue;
          ++failed;
          BOOST_TEST((simulated.state().pose.theta == before.pose.theta));
          BOOST_TEST((simulated.state().rate == before.rate));
          BOOST_TEST(simulated.port() == port);
          BOOST_TEST(simulated.dissipated() == dissipated);
        }
      }
  BOOST_TEST(failed > 0u);
}

BOOST_AUTO_TEST_CASE(a_path_ends_with_its_last_row_and_a_delay_is_the_one_that_was_given) {
  BOOST_TEST(Hand_path({{0, {0, 0, 0}, 0}, {2.5, {1, 0, 0}, 0}}).end() == 2.5);
  BOOST_TEST(Torque_delay<double>(1.7).ticks() == 1.7);
}

} // namespace
