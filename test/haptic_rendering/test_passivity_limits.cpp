// SPDX-License-Identifier: GPL-3.0-or-later
// The stiffness up to which a held spring gives no energy: at the worst pose, found by prescribed motions, in runs.
#include "haptic_rendering/devices_of_tests.h"
#include "sculpting/public_functions/Callers_mode.h"

#include <haptic_sculpt/haptic_rendering/Force_renderer.h>
#include <haptic_sculpt/haptic_rendering/Passivity_limits.h>
#include <haptic_sculpt/haptic_rendering/Passivity_observer.h>
#include <haptic_sculpt/haptic_rendering/Pose_loop.h>
#include <haptic_sculpt/haptic_rendering/check_coupling.h>
#include <haptic_sculpt/haptic_rendering/simulation/Simulated_device.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace haptic_sculpt;
using namespace haptic_rendering_tests;

namespace {

BOOST_AUTO_TEST_CASE(the_worst_pose_is_at_least_as_bad_as_any_drawn) {
  Random random(haptic_sculpt::test::seed_from_environment(5));
  std::uniform_real_distribution<double> angle(-0.5, 2.5);
  const Force_limits limits;
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_parameters<double> parameters = device(form, 0.005);
    const auto home = home_pose(parameters);
    const double radius = workspace_radius(parameters, *home);
    const Worst_pose worst =
        worst_pose(parameters, limits, [&](const Vector3d& p) { return (p - home->position).norm() <= radius; });
    BOOST_TEST(worst.is_found);
    int compared = 0;
    for (int i = 0; i < 30000; ++i) {
      const double a = angle(random), b = angle(random), c = angle(random);
      const auto pose = forward_kinematics(parameters, Vector3d(a, b, c));
      if (!pose || (pose->position - home->position).norm() > radius ||
          working_mode(parameters, *pose) != working_mode(parameters, *home))
        continue;
      const Eigen::Vector3d values =
          Eigen::JacobiSVD<Eigen::Matrix3d>(jacobian(parameters, *pose)->linear).singularValues();
      const double bad = values[0] * values[0] * fading_by_condition(limits, values[0] / values[2]);
      BOOST_TEST(bad <= worst.greatest * worst.greatest * worst.fading * (1 + 1e-9));
      ++compared;
    }
    BOOST_TEST(compared >= 100);
    BOOST_TEST_MESSAGE((form == Device_form::general ? "general" : "di-tetrahedral")
                       << ": ball of " << radius << " m, sigma_max " << worst.greatest << " m/rad, b_phys "
                       << worst.friction(parameters) << " N s/m, k_p at 1 kHz "
                       << passive_stiffness(worst.friction(parameters), 0, 0.001, 0) << " N/m");
  }
}

/// The energy that a spring of stiffness k along `direction`, held a tick, takes from a prescribed small motion, per
/// work of friction: below -1 it is active. Analytic device: joints move along one line, at constant rate, there and
/// back.
double energy_over_friction(const Device_parameters<double>& parameters, const Vector3d& theta, double stiffness,
                            double tick) {
  const auto pose = forward_kinematics(parameters, theta);
  const auto map = jacobian(parameters, *pose);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(map->linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vector3d normal = svd.matrixU().col(0), way = svd.matrixV().col(0);
  const double rate = 0.01, preload = 0.002; // rad/s, m
  const int half = 50;
  Passivity_observer observer(0, tick, parameters.viscous_friction(), 0);
  Vector3d now = theta, before = theta;
  double taken = 0, dissipated = 0;
  const Vector3d start = pose->position;
  for (int k = 0; k <= 2 * half; ++k) {
    now = theta + way * rate * tick * (k <= half ? k : 2 * half - k);
    const Vector3d step = now - before;
    observer.add_step(step, stiffness, Vector3d::Zero());
    const auto at = forward_kinematics(parameters, now, *pose);
    const auto here = jacobian(parameters, *at);
    const Vector3d force = stiffness * normal * (preload - normal.dot(at->position - start));
    observer.command(here->linear.transpose() * force);
    before = now;
  }
  taken = observer.port(), dissipated = observer.dissipated();
  return taken / dissipated;
}

BOOST_AUTO_TEST_CASE(beyond_the_passive_limit_a_prescribed_motion_finds_activity) {
  Random random(haptic_sculpt::test::seed_from_environment(6));
  std::uniform_real_distribution<double> angle(0.5, 1.5), tick_of(2.5e-4, 4e-3);
  double least = 10, largest = 0;
  int tried = 0;
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_parameters<double> parameters = device(form, 0.005);
    for (int i = 0; i < 100; ++i) {
      const double a = angle(random), b = angle(random), c = angle(random), tick = tick_of(random);
      const Vector3d theta(a, b, c);
      const auto pose = forward_kinematics(parameters, theta);
      if (!pose)
        continue;
      const auto conditioning = translation_conditioning(*jacobian(parameters, *pose));
      if (!(conditioning.condition < 10))
        continue;
      ++tried;
      const double limit = passive_stiffness(0.005 / (conditioning.greatest * conditioning.greatest), 0, tick, 0);
      double low = 0.1 * limit, high = 10 * limit;
      BOOST_TEST(energy_over_friction(parameters, theta, low, tick) > -1);
      BOOST_TEST(energy_over_friction(parameters, theta, high, tick) < -1);
      for (int halving = 0; halving < 30; ++halving) {
        const double middle = 0.5 * (low + high);
        (energy_over_friction(parameters, theta, middle, tick) < -1 ? high : low) = middle;
      }
      least = std::min(least, low / limit), largest = std::max(largest, low / limit);
    }
  }
  BOOST_TEST_MESSAGE(tried << " poses: stiffness at which activity begins over the formula " << least << " to "
                           << largest);
  BOOST_TEST(tried >= 100);
  BOOST_TEST(least >= 0.9);
  BOOST_TEST(largest <= 1.1);
}

BOOST_AUTO_TEST_CASE(all_encoders_between_two_counts_make_no_more_of_a_calm_spring_than_is_permitted) {
  Random random(haptic_sculpt::test::seed_from_environment(12));
  std::uniform_real_distribution<double> angle(0.4, 1.6);
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_parameters<double> parameters = device(form, 0.005, 1.53e-4);
    const auto home = home_pose(parameters);
    const double radius = workspace_radius(parameters, *home);
    const auto is_inside = [&](const Vector3d& p) { return (p - home->position).norm() <= radius; };
    const Worst_pose worst = worst_pose(parameters, Force_limits(), is_inside);
    const double calm = calm_stiffness(worst.count(parameters), 0);
    double most = 0; // N, of the changes of the force between two readings
    for (int i = 0; i < 3000; ++i) {
      const double a = angle(random), b = angle(random), c = angle(random);
      const auto pose = forward_kinematics(parameters, Vector3d(a, b, c));
      if (!pose || !is_inside(pose->position) || working_mode(parameters, *pose) != working_mode(parameters, *home))
        continue;
      const auto map = jacobian(parameters, *pose);
      const double fading = fading_by_condition(Force_limits(), translation_conditioning(*map).condition);
      for (const Vector3d& counts : {Vector3d(1, 0, 0), Vector3d(1, 1, 0), Vector3d(1, -1, 0), Vector3d(1, 1, 1),
                                     Vector3d(1, 1, -1), Vector3d(1, -1, 1), Vector3d(-1, 1, 1)})
        if (const auto next = forward_kinematics(
                parameters, Vector3d(pose->theta + parameters.encoder_step() * counts), *pose))
          most = std::fmax(most, fading * calm * (next->position - pose->position).norm());
    }
    BOOST_TEST_MESSAGE("counts change the force by at most " << most << " N at " << calm << " N/m");
    BOOST_TEST(most <= largest_restlessness * 1.001); // the Jacobian turns by some 1e-4 in a count
    BOOST_TEST(most >= largest_restlessness / 2);
    BOOST_TEST(calm_stiffness(worst.count(device(form, 0.005)), 1) == std::numeric_limits<double>::infinity());
    BOOST_TEST(calm_stiffness(worst.count(parameters), 1) < calm - 600); // 2 pi 100 Hz
  }
}

BOOST_AUTO_TEST_CASE(limits_that_were_made_for_something_else_or_by_nobody_are_refused) {
  const Device_parameters<double> parameters = device(Device_form::ditetrahedral, 0.005, 1.53e-4);
  const auto home = home_pose(parameters);
  const Workspace_map map(50, Vector3d(0.3, -0.2, 0.9), Vector3d(1, 2, 3), home->position);
  const auto is_inside = [&](const Vector3d& p) { return (p - home->position).norm() <= 0.02; };
  const Haptic_parameters asked;
  for (const int per_joint : {1, 0, -3, 2000}) {
    BOOST_CHECK_THROW(worst_pose(parameters, asked.limits, is_inside, per_joint), Error);
    BOOST_CHECK_THROW(lightest_pose(parameters, asked.limits, is_inside, per_joint), Error);
  }
  const Worst_pose worst = worst_pose(parameters, asked.limits, is_inside, 9),
                   lightest = lightest_pose(parameters, asked.limits, is_inside, 7);
  const Passivity_limits made = passivity_limits(parameters, asked.limits, map, worst, lightest, 0, 0.001, 0);
  check_limits(made, parameters, map, asked);
  for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) { // of a caller: it is the same loop
    const haptic_sculpt::test::Callers_mode mode(rounding, true);
    check_limits(made, parameters, map, asked);
    const Passivity_limits here =
        passivity_limits(parameters, asked.limits, map, worst_pose(parameters, asked.limits, is_inside, 9),
                         lightest_pose(parameters, asked.limits, is_inside, 9), 0, 0.001, 0);
    check_limits(here, parameters, map, asked);
  }
  const auto is_refused = [](const Passivity_limits& limits, const Device_parameters<double>& device,
                             const Workspace_map& place, const Haptic_parameters& wanted) {
    BOOST_CHECK_EXCEPTION(check_limits(limits, device, place, wanted), Error, [](const Error& error) {
      return std::string(error.what()).find("were made for another") != std::string::npos;
    });
  };
  is_refused(made, device(Device_form::ditetrahedral, 0.006, 1.53e-4), map, asked);
  is_refused(made, device(Device_form::ditetrahedral, 0.005, 1e-4), map, asked);
  is_refused(made, device(Device_form::general, 0.005, 1.53e-4), map, asked);
  Device_description<double> lighter = named_design<double>(Named_design::D1, Device_form::ditetrahedral);
  lighter.viscous_friction = 0.005, lighter.encoder_step = 1.53e-4, lighter.platform_mass *= 0.5;
  is_refused(made, Device_parameters<double>(lighter), map, asked);
  for (const Workspace_map& other : {Workspace_map(51, Vector3d(0.3, -0.2, 0.9), Vector3d(1, 2, 3), home->position),
                                     Workspace_map(50, Vector3d(0.3, -0.2, 0.8), Vector3d(1, 2, 3), home->position),
                                     Workspace_map(50, Vector3d(0.3, -0.2, 0.9), Vector3d(1, 2, 4), home->position),
                                     Workspace_map(50, Vector3d(0.3, -0.2, 0.9), Vector3d(1, 2, 3), Vector3d(0, 0, 0))})
    is_refused(made, parameters, other, asked);
  const auto is_refused_with = [&](const auto& change) {
    Haptic_parameters wanted = asked;
    change(wanted);
    is_refused(made, parameters, map, wanted);
  };
  is_refused_with([](Haptic_parameters& p) { p.tick = 0.0011; });
  is_refused_with([](Haptic_parameters& p) { p.delay = 1; });
  is_refused_with([](Haptic_parameters& p) { p.tick = 0.0005, p.delay = 0.5; }); // of the same passive stiffness
  is_refused_with([](Haptic_parameters& p) { p.coupling.damping = 0.01; });
  is_refused_with([](Haptic_parameters& p) { p.virtual_mass.cutoff = 90; });
  is_refused_with([](Haptic_parameters& p) { p.limits.full_condition = 11; });
  is_refused_with([](Haptic_parameters& p) { p.limits.no_condition = 21; });
  Passivity_limits by_hand; // no worst pose was sought
  by_hand.passive_stiffness = 1e7, by_hand.tick = asked.tick;
  is_refused(by_hand, parameters, map, asked);
  by_hand.map = map, by_hand.full_condition = 10, by_hand.no_condition = 20;
  is_refused(by_hand, parameters, map, asked);
  Passivity_limits changed = made;
  changed.passive_stiffness *= 2;
  is_refused(changed, parameters, map, asked);
}

BOOST_AUTO_TEST_CASE(a_device_within_the_passive_limit_gives_no_energy) {
  Random random(haptic_sculpt::test::seed_from_environment(9));
  std::uniform_real_distribution<double> unit(0, 1);
  double least = 0, largest_port = 0;
  std::size_t ticks_in_contact = 0;
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    Device_description<double> description = named_design<double>(Named_design::D1, form);
    description.viscous_friction = 0.005, description.torque_limit = 10;
    const Device_parameters<double> parameters(description);
    const auto home = home_pose(parameters);
    const double radius = 0.9 * workspace_radius(parameters, *home);
    const Worst_pose worst = worst_pose(parameters, Force_limits(),
                                        [&](const Vector3d& p) { return (p - home->position).norm() <= 1.2 * radius; });
    for (int run = 0; run < 16; ++run) {
      const double tick = 2.5e-4 * std::pow(8.0, unit(random)), delay = run % 3 == 0 ? 0 : 2 * unit(random);
      const double friction = worst.friction(parameters), damping = run % 2 == 0 ? 0 : 0.5 * friction * unit(random);
      const Virtual_coupling coupling{passive_stiffness(friction, damping, tick, delay) * (0.2 + 0.8 * unit(random)),
                                      damping};
      Vector3d normal = random_vector(random).normalized();
      std::vector<Hand_path::Row> rows;
      for (int row = 0; row < 12; ++row)
        rows.push_back(
            {0.1 * row, home->position + radius * 0.5 * unit(random) * random_vector(random).normalized(), 0});
      if (normal.dot(rows[0].position - home->position) < 0) // begins outside: no energy is stored
        normal = -normal;
      const Hand_path path(rows);
      const auto start = reach_position(parameters, *home, rows[0].position);
      BOOST_REQUIRE(start);
      Handle_motion handle(parameters, *start, tick);
      Simulated_device simulated(parameters, *start, run % 4 < 2 ? Simulated_hand::finger() : Simulated_hand::arm(),
                                 path, tick, delay);
      Force_renderer renderer(no_limits(), Virtual_coupling(), Gravity_compensation::spatial, tick);
      Contact_span span;
      span.add(normal);
      while (simulated.time() < 1) {
        if (!(handle.follow(simulated.read().theta) < 10))
          break;
        const double depth = -normal.dot(handle.position() - home->position);
        const bool reached = depth <= 0;
        ticks_in_contact += !reached;
        const Vector3d wall = reached ? Vector3d(0, 0, 0) : Vector3d(coupling.stiffness * depth * normal);
        const Rendered_force rendered =
            renderer.render(handle, wall + coupling.damping_force(span, handle.velocity(), reached));
        if (simulated.write(rendered.torque, rendered.interaction_torque) != Device_status::success)
          break;
        least = std::min(least, simulated.port() + simulated.dissipated());
        largest_port = std::max(largest_port, std::abs(simulated.port()));
      }
    }
  }
  BOOST_TEST_MESSAGE("32 runs within the passive limit, "
                     << ticks_in_contact << " ticks in contact: least energy of port and friction " << least
                     << " J, port at most " << largest_port << " J");
  BOOST_TEST(ticks_in_contact > 10000u);
  BOOST_TEST(least >= -1e-9);
}

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

BOOST_AUTO_TEST_CASE(what_is_set_by_default_is_permitted_whatever_the_device_weighs) {
  Pose_loop_parameters pose(2);
  pose.device.mass = 1e9;
  BOOST_TEST(pose.largest_controller() == Passivity_controller::largest_damping);
  Device_description<double> description = device(Device_form::ditetrahedral).description();
  description.platform_mass = 400.5;
  const Device_parameters<double> heavy(description);
  const Vector3d home = home_pose(heavy)->position, box(0.01, 0.01, 0.01);
  const Workspace_map map(1, Vector3d(0, 0, 0), Vector3d(0, 0, 0), home);
  const Passivity_limits limits = passivity_limits(heavy, Force_limits(), map, Vector3d(-box), box, 0, 1e-3, 0);
  BOOST_TEST(limits.default_controller() > 0);
  BOOST_CHECK_NO_THROW(Passivity_controller(limits.default_controller(), 1e-3));
  // Exact places are written as -0, too.
  BOOST_TEST(calm_stiffness(-0.0, 1) == std::numeric_limits<double>::infinity());
}

} // namespace
