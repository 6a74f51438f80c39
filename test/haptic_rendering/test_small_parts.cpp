// SPDX-License-Identifier: GPL-3.0-or-later
// Public functions of the loop's small parts that no test of a whole loop asks by themselves, beside what they stand
// for written out again.
#include "haptic_rendering/devices_of_tests.h"

#include <haptic_sculpt/haptic_rendering/Acceleration_estimate.h>
#include <haptic_sculpt/haptic_rendering/Force_renderer.h>
#include <haptic_sculpt/haptic_rendering/Passivity_limits.h>
#include <haptic_sculpt/haptic_rendering/Pose_loop.h>
#include <haptic_sculpt/haptic_rendering/Refusal_burst.h>
#include <haptic_sculpt/haptic_rendering/Tick_statistics.h>
#include <haptic_sculpt/haptic_rendering/Velocity_estimate.h>
#include <haptic_sculpt/haptic_rendering/exchange/Edit_journal.h>
#include <haptic_sculpt/haptic_rendering/simulation/Hand_path.h>
#include <haptic_sculpt/haptic_rendering/simulation/Simulated_hand.h>

#include <boost/test/unit_test.hpp>

#include <Eigen/SVD>

#include <cmath>
#include <limits>
#include <string>

using namespace haptic_sculpt;
using namespace haptic_rendering_tests;

namespace {

BOOST_AUTO_TEST_CASE(limits_permit_what_is_both_passive_and_calm) {
  Passivity_limits limits;
  const auto are = [&](double passive, double calm, double largest) {
    limits.passive_stiffness = passive, limits.calm_stiffness = calm;
    BOOST_TEST(limits.largest_stiffness() == largest);
    BOOST_TEST(limits.recommended_stiffness() == largest / 2);
    BOOST_TEST(limits.permits({largest, 0}));
    BOOST_TEST(!limits.permits({std::nextafter(largest, 1e9), 0}));
    BOOST_TEST(!limits.permits({NAN, 0}));
  };
  are(800, 600, 600), are(500, 600, 500), are(500, std::numeric_limits<double>::infinity(), 500);
  are(-10, 600, 0), are(500, -1, 0);
  limits.largest_controller = 3;
  BOOST_TEST(limits.default_controller() == 1.5);
  Pose_loop_parameters pose(2); // of a device twice as heavy a controller may take twice as much
  BOOST_TEST(pose.largest_controller() > 0);
  pose.device.mass *= 2;
  BOOST_TEST(std::abs(pose.largest_controller() / Pose_loop_parameters(2).largest_controller() - 2) <= 1e-12);
  BOOST_TEST(Pose_loop_parameters::without_force().largest_controller() == 0);
}

BOOST_AUTO_TEST_CASE(a_coupling_is_as_stiff_as_spring_and_snap_and_needs_friction_for_both) {
  Haptic_parameters parameters;
  parameters.coupling = {300, 0.7}, parameters.tick = 0.002, parameters.delay = 1.5;
  BOOST_TEST(parameters.stiffest().stiffness == 300);
  parameters.snap.length = 0.01, parameters.snap.force = 2; // 2 N within half of the length
  const Virtual_coupling both = parameters.stiffest();
  BOOST_TEST(both.stiffness == 300 + 400);
  BOOST_TEST(both.damping == 0.7);
  // With just so much friction the stiffness is at the passive limit.
  BOOST_TEST(std::abs(passive_stiffness(parameters.needed_friction(), 0.7, 0.002, 1.5) / both.stiffness - 1) <= 1e-12);
}

BOOST_AUTO_TEST_CASE(the_part_of_a_vector_in_a_span_is_the_nearest_combination_of_the_normals) {
  Random random(61);
  for (int i = 0; i < 300; ++i) {
    const int normals = 1 + i % 4;
    Contact_span span;
    const Vector3d any = random_vector(random, 1);
    BOOST_TEST(span.part(any) == Vector3d::Zero());
    Eigen::MatrixXd columns(3, normals);
    for (int k = 0; k < normals; ++k) { // the third in the plane of the two before
      const Vector3d normal = k == 2 ? Vector3d(columns.col(0) - 2 * columns.col(1)) : random_vector(random, 1);
      span.add(normal);
      columns.col(k) = normal.normalized();
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(columns, Eigen::ComputeThinU);
    Vector3d nearest = Vector3d::Zero();
    bool is_clear = true; // no two of them nearly the same
    for (int k = 0; k < svd.singularValues().size(); ++k)
      if (const double value = svd.singularValues()[k]; value > 1e-9) {
        is_clear = is_clear && value > 0.2;
        nearest += svd.matrixU().col(k).dot(any) * svd.matrixU().col(k);
      }
    if (is_clear)
      BOOST_TEST((span.part(any) - nearest).norm() <= 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(a_damper_behind_its_low_pass_changes_by_no_more_than_is_said_for_a_step) {
  for (const double tick : {0.00025, 0.001, 0.004}) {
    Velocity_estimate velocity(tick);
    const double step = 1e-4, damping = 2;
    const double change = damping * velocity.add(Vector3d(step, 0, 0)).norm();
    BOOST_TEST(change <= Velocity_estimate::change_of_way(damping) * step);
    if (tick < 0.0005)
      BOOST_TEST(change >= 0.9 * Velocity_estimate::change_of_way(damping) * step);
    BOOST_TEST((velocity.value() - Vector3d(change / damping, 0, 0)).norm() <= 1e-12);
    velocity.reset();
    BOOST_TEST(velocity.value() == Vector3d::Zero());
    Acceleration_estimate acceleration(tick);
    acceleration.add(Vector3d(step, 0, 0)), acceleration.add(Vector3d(3 * step, 0, 0));
    BOOST_TEST(acceleration.value()[0] > 0);
    acceleration.reset();
    BOOST_TEST(acceleration.value() == Vector3d::Zero());
    BOOST_TEST(acceleration.add(Vector3d(step, 0, 0)) == Vector3d::Zero()); // no second difference yet
  }
}

BOOST_AUTO_TEST_CASE(a_burst_gives_its_samples_and_none_once_it_is_cut) {
  for (const double tick : {0.0001, 0.001, 0.004}) {
    Refusal_burst burst(tick);
    BOOST_TEST(std::abs(burst.samples() * tick - Refusal_burst::duration) <= tick / 2 + 1e-12);
    const Vector3d up(0, 0, 1);
    burst.begin(up, 1e-9); // as good as immovable: the whole amplitude
    for (int k = 0; k < burst.samples() / 2; ++k) {
      BOOST_TEST((burst.next() - burst.sample(k) * up).norm() <= 1e-15);
      BOOST_TEST(burst.sample(k) == burst.sample(burst.samples() - 1 - k));
    }
    BOOST_TEST(!burst.is_over());
    burst.cut();
    BOOST_TEST(burst.is_over());
    BOOST_TEST(burst.next() == Vector3d::Zero());
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
  chain.follow(Vector3d::Zero(), 0);
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

BOOST_AUTO_TEST_CASE(a_map_that_is_pinned_leads_one_place_to_another_and_keeps_its_rotation) {
  Random random(62);
  for (int i = 0; i < 100; ++i) {
    const Vector3d rotation = random_vector(random, 2), home = random_vector(random, 0.1);
    const Workspace_map map(40, rotation, random_vector(random, 3), home);
    const Vector3d device = random_vector(random, 0.1), scene = random_vector(random, 5), x = random_vector(random, 1);
    const Workspace_map pinned = map.pinned(device, scene, 55);
    BOOST_TEST((pinned.to_scene(device) - scene).norm() <= 1e-12);
    BOOST_TEST((pinned.scale() == 55 && pinned.home() == home && pinned.rotation_vector() == rotation));
    // Rodrigues' formula.
    const double angle = rotation.norm();
    const Vector3d axis = rotation / angle,
                   turned = std::cos(angle) * x + std::sin(angle) * axis.cross(x) +
                            (1 - std::cos(angle)) * axis.dot(x) * axis;
    BOOST_TEST((map.rotation() * x - turned).norm() <= 1e-12);
    BOOST_TEST((pinned.rotation() * x - turned).norm() <= 1e-12);
    BOOST_CHECK_THROW(map.pinned(device, scene, 0), Error);
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
  Random random(63);
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

BOOST_AUTO_TEST_CASE(the_first_fault_that_is_reported_stays) {
  Watchdog watchdog(Watchdog_limits(), 0.001, 0.2);
  watchdog.report(Loop_fault::none);
  BOOST_TEST((watchdog.fault() == Loop_fault::none));
  watchdog.report(Loop_fault::energy), watchdog.report(Loop_fault::log);
  BOOST_TEST((watchdog.fault() == Loop_fault::energy));
  BOOST_TEST(!watchdog.check(Vector3d::Zero(), Vector3d::Zero(), 0.001));
  watchdog.reset();
  BOOST_TEST((watchdog.fault() == Loop_fault::none));
  BOOST_TEST(watchdog.check(Vector3d::Zero(), Vector3d::Zero(), 0.001));
}

BOOST_AUTO_TEST_CASE(a_handle_is_as_fast_as_its_jacobian_and_steps_begin_after_the_first_angles) {
  Random random(64);
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_parameters<double> parameters = device(form);
    Handle_motion handle(parameters, *home_pose(parameters), 0.001);
    BOOST_TEST((!handle.has_step() && handle.greatest() == 0));
    for (int i = 0; i < 20; ++i) {
      handle.follow(home_pose(parameters)->theta + random_vector(random, 0.2), 0.001);
      BOOST_TEST(handle.has_step() == (i > 0));
      const Eigen::JacobiSVD<Eigen::Matrix3d> svd(handle.jacobian().linear);
      BOOST_TEST(std::abs(handle.greatest() / svd.singularValues()[0] - 1) <= 1e-9);
    }
    handle.restart();
    handle.follow(home_pose(parameters)->theta, 0.001);
    BOOST_TEST(!handle.has_step());
  }
}

BOOST_AUTO_TEST_CASE(parts_that_are_checked_by_themselves_name_what_no_device_has) {
  const auto refuses = [](const char* name, const auto& part) {
    BOOST_CHECK_EXCEPTION(part.check(), Error, [&](const Error& error) {
      return std::string(error.what()).find(name) != std::string::npos;
    });
  };
  Force_limits().check(), Virtual_coupling().check(), Virtual_mass_parameters().check(), Simulated_hand::arm().check();
  Force_limits forces;
  forces.largest = NAN;
  refuses("largest force", forces);
  refuses("stiffness", Virtual_coupling{-1, 0});
  Virtual_mass_parameters mass;
  mass.mass = 11;
  refuses("virtual mass", mass);
  Simulated_hand hand = Simulated_hand::arm();
  hand.stage[1].mass = 0;
  refuses("stage 1", hand);
  hand.stages = 4;
  refuses("4", hand);
}

BOOST_AUTO_TEST_CASE(numbers_that_are_told_are_those_that_were_given) {
  const Edit_journal journal(70);
  BOOST_TEST(journal.most_age() == 70u);
  BOOST_TEST(Torque_delay<double>(1.7).ticks() == 1.7);
  BOOST_TEST(Hand_path({{0, {0, 0, 0}, 0}, {2.5, {1, 0, 0}, 0}}).end() == 2.5);
  Tick_statistics statistics;
  BOOST_TEST((statistics.number() == 0u && statistics.largest() == 0u && statistics.percentile(0.5) == 0u));
  statistics.add(7), statistics.add(9), statistics.add(8);
  BOOST_TEST((statistics.number() == 3u && statistics.largest() == 9u && statistics.percentile(0.5) == 8u));
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
}

} // namespace
