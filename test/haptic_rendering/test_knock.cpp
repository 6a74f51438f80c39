// SPDX-License-Identifier: GPL-3.0-or-later
// A hand that comes down on a wall fast, and a handle that is thrown at it: no energy, and calm soon, with every limit
// of the force as it comes.
#include "haptic_rendering/knock.h"

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <limits>
#include <random>
#include <vector>

using namespace haptic_sculpt;
using namespace haptic_rendering_tests;

namespace {

/// J: of port plus dissipation; what a spring that comes late gives is hundreds of times as much.
constexpr double permitted = -1e-3;

BOOST_AUTO_TEST_CASE(a_knock_gives_no_energy_and_is_calm_after_half_a_second_with_all_that_ships) {
  int number = 0;
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Knocked_device knocked(form);
    for (const double rate : {1000.0, 4000.0, 10000.0})
      for (const double delay : {0.0, 1.0})
        for (const std::optional<Simulated_hand>& hand :
             {std::optional(Simulated_hand::finger()), std::optional(Simulated_hand::arm()),
              std::optional<Simulated_hand>()}) {
          Knock k;
          k.rate = rate, k.delay = delay, k.hand = hand;
          k.stiffness_share = hand ? 0.95 : 0.5, k.damping_share = number++ % 2 == 0 ? 0 : 0.5;
          const Knock_outcome outcome = run_knock(knock(knocked, k), k.wait);
          BOOST_TEST((outcome.run.fault == Loop_fault::none));
          BOOST_TEST(outcome.run.largest_force > 0.1); // it has touched
          BOOST_TEST(outcome.run.least >= permitted);
          BOOST_TEST(outcome.ripple <= largest_restlessness,
                     "a ripple of " << outcome.ripple << " N at " << rate << " Hz, delay " << delay);
        }
  }
}

BOOST_AUTO_TEST_CASE(a_ramp_that_rises_while_a_hand_presses_gives_it_no_energy) {
  double least = 0;
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Knocked_device knocked(form);
    for (const double rate : {2000.0, 5000.0, 7500.0})
      for (const double share : {0.4, 0.8}) {
        Knock k;
        k.rate = rate, k.stiffness_share = share, k.hand = Simulated_hand::measured_arm(), k.wait = 0;
        k.normal = Vector3d::UnitX();
        const Contact_setup setup = knock(knocked, k);
        double last_share = 0; // of the force in that of the spring
        const Contact_outcome outcome =
            run_contact(setup, 1e9, [&](const Simulated_device& device, const Handle_motion& handle, const auto& made) {
              const double depth = -setup.normal.dot(handle.position() - setup.on_plane);
              if (depth > 0.0002)
                last_share = made.force.norm() / (setup.coupling.stiffness * depth);
              return device.time() < 0.75;
            });
        least = std::fmin(least, outcome.least);
        BOOST_TEST((outcome.fault == Loop_fault::none));
        BOOST_TEST(last_share > 0.9); // and has come to its end
      }
  }
  BOOST_TEST_MESSAGE("least energy while a ramp rises: " << 1e3 * least << " mJ");
  BOOST_TEST(least >= -0.1e-3); // J: of encoder steps; a ramp that does not wait gives ten times as much
}

BOOST_AUTO_TEST_CASE(a_spring_that_is_back_after_work_was_cut_short_gives_no_energy) {
  double least = 0;
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Knocked_device knocked(form);
    for (const double rate : {1000.0, 4000.0})
      for (const double wait : {0.31, 0.33, 0.35}) {
        Knock k;
        k.rate = rate, k.hand = Simulated_hand::arm(), k.wait = wait, k.normal = Vector3d::UnitX();
        Contact_setup setup = knock(knocked, k);
        setup.starved_share = 0.1;
        const Contact_outcome outcome = run_knock(setup, wait).run;
        least = std::fmin(least, outcome.least);
        BOOST_TEST((outcome.fault == Loop_fault::none));
        BOOST_TEST(outcome.largest_force > 1);
      }
  }
  BOOST_TEST_MESSAGE("least energy with work cut short: " << 1e3 * least << " mJ");
  BOOST_TEST(least >= -0.1e-3); // J: of encoder steps; a spring that is back at once gives twenty times as much
}

BOOST_AUTO_TEST_CASE(what_the_proxy_does_is_slewed_and_what_the_hand_does_is_not) {
  const Virtual_coupling coupling{1000, 2};
  Force_limits limits;
  limits.ramp_time = 0;
  Force_chain chain(limits, coupling, 0.001);
  const Vector3d up(0, 0, 1);
  BOOST_TEST((chain.follow(2 * up, 0.002, 0.001) - 2 * up).norm() <= 1e-15); // 2 mm of the spring
  BOOST_TEST((chain.follow(0 * up, 0, 0.001) - 1.7 * up).norm() <= 1e-12);   // the proxy falls
  const double damper = 2 * M_PI * 100 * 2 * 0.0005;                  // of a step of 0.5 mm
  BOOST_TEST((chain.follow(4 * up, 0.0005, 0.001) - (1.7 + 0.3 + 0.5 + damper) * up).norm() <= 1e-12);
  const Vector3d now = (1.7 + 0.3 + 0.5 + damper) * up; // an early tick may change it less, a late one no more
  BOOST_TEST((chain.follow(9 * up, 0, 0.0002) - now - 0.06 * up).norm() <= 1e-12);
  BOOST_TEST((chain.follow(9 * up, 0, 0.005) - now - 0.36 * up).norm() <= 1e-12);
  const Vector3d last = chain.follow(2 * up, 0.01, 0.001); // a step of the hand that lets it all through
  BOOST_TEST((last - 2 * up).norm() <= 1e-12);
  chain.cut_to(0.5); // more has not come to the hand
  BOOST_TEST((chain.follow(0 * up, 0, 0.001) - 0.7 * up).norm() <= 1e-12);
  chain.cut_to(0);
  BOOST_TEST(chain.follow(0 * up, 0, 0.001) == 0 * up);
}

BOOST_AUTO_TEST_CASE(a_device_that_gives_energy_ends_as_a_fault) {
  const Knocked_device knocked(Device_form::ditetrahedral);
  for (const double times : {20.0, 40.0}) { // what nobody foresaw: the device is not what it was taken to be
    Knock k;
    k.stiffness_share = times, k.hand = Simulated_hand::finger();
    Contact_setup setup = knock(knocked, k);
    setup.controller_damping = 0;
    const Contact_outcome outcome = run_contact(setup, 3);
    BOOST_TEST_MESSAGE(times << " k_p: least energy " << 1e3 * outcome.least << " mJ, force at most "
                             << outcome.largest_force << " N, " << name_of(outcome.fault) << " at " << outcome.time
                             << " s");
    BOOST_TEST((outcome.fault == Loop_fault::energy));
    BOOST_TEST(outcome.least >= -30e-3); // J: it ends within few swings
  }
}

BOOST_AUTO_TEST_CASE(a_device_that_gives_energy_after_long_free_motion_ends_as_a_fault_as_soon) {
  const Knocked_device knocked(Device_form::ditetrahedral);
  Knock k;
  k.stiffness_share = 20, k.hand = Simulated_hand::finger(), k.wait = 30;
  Contact_setup setup = knock(knocked, k);
  setup.controller_damping = 0;
  std::vector<Hand_path::Row> rows = setup.path.rows();
  const Hand_path::Row above = rows[1], below = rows[2];
  rows.pop_back();
  rows[1].time = 0.35;
  for (int swing = 0; rows.back().time + 0.2 < k.wait; ++swing) // in the air: friction takes what the hand gives
    rows.push_back({rows.back().time + 0.1, above.position + (swing % 2 ? 0.01 : -0.01) * Vector3d::UnitX(), 0});
  rows.push_back(above), rows.push_back(below);
  setup.path = Hand_path(rows);
  double most = 0, drop = 0; // J, of port plus dissipation
  const Contact_outcome outcome = run_contact(setup, 15, [&](const Simulated_device& device, const auto&, const auto&) {
    most = std::fmax(most, device.port() + device.dissipated());
    drop = std::fmax(drop, most - device.port() - device.dissipated());
    return true;
  });
  BOOST_TEST_MESSAGE("friction took " << most << " J; then " << drop << " J were given, " << name_of(outcome.fault)
                                      << " at " << outcome.time << " s");
  BOOST_TEST((outcome.fault == Loop_fault::energy));
  BOOST_TEST(drop < most / 2); // the reserve, what the spring held, and some swings; all of it before
}

BOOST_AUTO_TEST_CASE(a_loop_that_is_late_lets_go_of_a_free_handle_before_it_throws_it) {
  const Knocked_device knocked(Device_form::ditetrahedral);
  Random random(haptic_sculpt::test::seed_from_environment(11));
  std::uniform_int_distribution<int> milliseconds(4, 16);
  const Vector3d up(0, 0, 1);
  double fastest[2] = {}; // upwards, m/s
  for (const bool is_watched : {true, false})
    for (int round = 0; round < 10; ++round) {
      Haptic_parameters parameters; // declared: 1 ms
      parameters.coupling.stiffness = 0.5 * passive_stiffness(knocked.friction, 0, parameters.tick, 0);
      parameters.limits.ramp_time = 0; // long under way
      if (!is_watched)
        parameters.watchdog.late_ticks = std::numeric_limits<double>::infinity();
      const Hand_path path({{0, knocked.home.position + 0.002 * up, 0}});
      const auto start = reach_position(knocked.device, knocked.home, path.at(0).position);
      Simulated_device device(knocked.device, *start, Simulated_hand{1, {}}, path, 0.001, 0);
      Interaction<Joint_side> loop(Joint_side(knocked.device, *start, parameters), parameters, 0);
      Joint_reading reading = device.read();
      bool is_torn = false;
      double fastest_after = 0;
      for (int k = 0; k < 40 && !is_torn; ++k) {
        if (k == 8) // the watchdog has had time to see how late the ticks are
          device.push(-0.5 * up);
        if (loop.fault() == Loop_fault::none && loop.follow(reading)) {
          const double depth = (knocked.home.position - loop.side().position())[2];
          Touch touch;
          touch.way = std::fmax(0, depth) * up, touch.is_free = depth <= 0, touch.span.add(up);
          loop.render(touch);
        }
        loop.end_tick();
        const int late = milliseconds(random);
        for (int held = 0; held < late && !is_torn; ++held)
          is_torn = device.write(loop.rendered().torque, loop.rendered().interaction_torque) != Device_status::success;
        reading = device.read(), reading.elapsed = 0.001 * late;
        const auto map = jacobian(knocked.device, device.state().pose);
        if (map)
          fastest_after = std::fmax(fastest_after, (map->linear * device.state().rate)[2]);
      }
      fastest[is_watched] = std::fmax(fastest[is_watched], fastest_after);
      if (is_watched) {
        BOOST_TEST(!is_torn);
        BOOST_TEST((loop.fault() == Loop_fault::late), name_of(loop.fault()));
        BOOST_TEST(loop.rendered().torque == Vector3d::Zero());
      }
    }
  BOOST_TEST_MESSAGE("thrown back at " << fastest[0] << " m/s at most, watched at " << fastest[1]);
  BOOST_TEST(fastest[1] <= 0.01);
  BOOST_TEST(fastest[0] > 0.05); // what the watchdog is for
}

} // namespace
