// SPDX-License-Identifier: GPL-3.0-or-later
// What lies between the proxy and the motors: maps, limits, bursts, energies, hands and paths. Needs no mesh.
#include <haptic_sculpt/haptic_rendering/Force_renderer.h>
#include <haptic_sculpt/haptic_rendering/Passivity_limits.h>
#include <haptic_sculpt/haptic_rendering/Passivity_observer.h>
#include <haptic_sculpt/haptic_rendering/simulation/Simulated_device.h>
#include <haptic_sculpt/haptic_rendering/Tick_statistics.h>
#include <haptic_sculpt/haptic_rendering/Watchdog.h>

#include <boost/test/unit_test.hpp>

#include <Eigen/SVD>

#include <algorithm>
#include <iostream>
#include <random>
#include <vector>

using namespace haptic_sculpt;
using Eigen::Vector3d;

namespace {

using Random = std::mt19937_64;

Vector3d random_vector(Random& random, double length = 1) {
  std::normal_distribution<double> number;
  const double x = number(random), y = number(random), z = number(random);
  return length * Vector3d(x, y, z);
}

Device_parameters<double> device(Device_form form, double friction, double encoder_step = 0) {
  Device_description<double> d = named_design<double>(Named_design::D1, form);
  d.viscous_friction = friction, d.encoder_step = encoder_step;
  return Device_parameters<double>(d);
}

Handle_motion handle_at(const Device_parameters<double>& parameters, const Vector3d& theta) {
  Handle_motion handle(parameters, *home_pose(parameters), 0.001);
  handle.follow(theta);
  return handle;
}

BOOST_AUTO_TEST_CASE(a_map_there_and_back_is_the_identity) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Workspace_map map(std::exp(5 * random_vector(random)[0]), random_vector(random, 3), random_vector(random, 10),
                            random_vector(random, 0.1));
    const Vector3d p = random_vector(random, 0.1), q = map.to_scene(p);
    BOOST_TEST((map.to_device(q) - p).norm() <= 1e-15 * (1 + q.norm() / map.scale()) * 20);
    // The rotation against Rodrigues' formula.
    const Vector3d w = map.rotation_vector(), axis = w.normalized(), x = random_vector(random);
    const Vector3d turned =
        x * std::cos(w.norm()) + axis.cross(x) * std::sin(w.norm()) + axis * axis.dot(x) * (1 - std::cos(w.norm()));
    BOOST_TEST((map.to_scene(map.home() + x) - map.origin() - map.scale() * turned).norm() <=
               1e-13 * map.scale() * (1 + x.norm()) + 1e-14 * (map.origin().norm() + map.scale() * map.home().norm()));
    BOOST_TEST((map.way_to_device(map.scale() * turned) - x).norm() <= 1e-13 * (1 + x.norm()));
  }
  BOOST_CHECK_THROW(Workspace_map(0, Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()), Error);
  BOOST_CHECK_THROW(Workspace_map(1, Vector3d::Constant(NAN), Vector3d::Zero(), Vector3d::Zero()), Error);
}

BOOST_AUTO_TEST_CASE(the_fitted_map_puts_the_corners_of_the_box_on_the_ball) {
  const Vector3d lower(-3, 1, 2), upper(5, 2, 9), home(0, 0, 0.13);
  const Workspace_map map = Workspace_map::fitted(lower, upper, home, 0.034);
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d p(corner & 1 ? lower[0] : upper[0], corner & 2 ? lower[1] : upper[1],
                     corner & 4 ? lower[2] : upper[2]);
    BOOST_TEST(std::abs((map.to_device(p) - home).norm() - 0.034) <= 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(damping_acts_along_pushes_only_and_only_while_held) {
  Random random(2);
  const Virtual_coupling coupling{1000, 2};
  for (int i = 0; i < 1000; ++i) {
    const Vector3d v = random_vector(random), n = random_vector(random).normalized(),
                   m = random_vector(random).normalized();
    if (n.cross(m).norm() < 2 * Contact_span::least_new_part)
      continue;
    Contact_span one, two, three;
    one.add(n), two.add(n), two.add(m), two.add((n + m).normalized());
    BOOST_TEST(one.size() == 1);
    BOOST_TEST(two.size() == 2);
    BOOST_TEST((coupling.damping_force(one, v, false) + 2 * n * n.dot(v)).norm() <= 1e-14 * v.norm());
    const Vector3d across = n.cross(m).normalized(); // the least-squares projection on the plane of n and m
    BOOST_TEST((coupling.damping_force(two, v, false) + 2 * (v - across * across.dot(v))).norm() <= 1e-12 * v.norm());
    three.add(n), three.add(m), three.add(across);
    BOOST_TEST((coupling.damping_force(three, v, false) + 2 * v).norm() <= 1e-12 * v.norm());
    BOOST_TEST(coupling.damping_force(one, v, true) == Vector3d::Zero());
  }
}

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

BOOST_AUTO_TEST_CASE(the_worst_pose_is_at_least_as_bad_as_any_drawn) {
  Random random(5);
  std::uniform_real_distribution<double> angle(-0.5, 2.5);
  const Force_limits limits;
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_parameters<double> parameters = device(form, 0.005);
    const auto home = home_pose(parameters);
    const double radius = workspace_radius(parameters, *home);
    const Worst_pose worst =
        worst_pose(parameters, limits, [&](const Vector3d& p) { return (p - home->position).norm() <= radius; });
    BOOST_TEST(worst.is_found);
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
    }
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
  Random random(6);
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

BOOST_AUTO_TEST_CASE(the_observer_counts_the_true_energy_of_the_port) {
  const Hand_path path(
      {{0, {0, 0, 0.132}, 0}, {0.2, {0.01, 0, 0.140}, 0}, {0.5, {-0.01, 0.01, 0.12}, 0}, {1, {0, 0, 0.13}, 0}});
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general})
    for (const double delay : {0.0, 0.3, 1.0, 1.7}) {
      const Device_parameters<double> parameters = device(form, 0.005);
      Handle_motion handle(parameters, *home_pose(parameters), 0.001);
      Simulated_device simulated(parameters, *home_pose(parameters), Simulated_hand::arm(), path, 0.001, delay);
      Passivity_observer observer(delay, 0.001, 0.005, 0);
      Force_renderer renderer(Force_limits(), Gravity_compensation::spatial, 0.001);
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

/// Nothing between the wanted force and the motors.
Force_limits no_limits() {
  Force_limits limits;
  limits.slew = limits.largest = 1e9, limits.ramp_time = 1e-9;
  return limits;
}

BOOST_AUTO_TEST_CASE(a_device_within_the_passive_limit_gives_no_energy) {
  Random random(9);
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
      Force_renderer renderer(no_limits(), Gravity_compensation::spatial, tick);
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

BOOST_AUTO_TEST_CASE(the_force_that_is_held_lags_by_no_more_than_the_rate_explains) {
  const Device_parameters<double> parameters = device(Device_form::ditetrahedral, 0.005);
  const auto home = home_pose(parameters);
  const double speed = 0.06, stiffness = 500;
  for (const double rate : {250.0, 1000.0, 4000.0, 10000.0})
    for (const double delay : {0.0, 0.5, 1.0}) {
      Handle_motion handle(parameters, *home, 1 / rate);
      Force_renderer renderer(no_limits(), Gravity_compensation::none, 1 / rate);
      Torque_delay<double> held(delay);
      double sum = 0, largest = 0;
      int samples = 0;
      Device_pose<double> pose = *home;
      const int ticks = static_cast<int>(0.1 * rate), parts = 8;
      for (int k = 0; k < ticks; ++k)
        for (int part = 0; part < parts; ++part) {
          const double fraction = (part + 0.5) / parts, time = (k + fraction) / rate;
          const auto depth_at = [&](double t) { return Vector3d(0, 0, -speed * t); };
          if (part == 0) {
            const auto now = reach_position(parameters, pose, Vector3d(home->position + depth_at(k / rate)));
            pose = *now;
            handle.follow(pose.theta);
            held.command(renderer.render(handle, -stiffness * (handle.position() - home->position)).interaction_torque);
          }
          if (k < 3)
            continue; // nothing has come through yet
          const auto there = reach_position(parameters, pose, Vector3d(home->position + depth_at(time)));
          const Vector3d torque = fraction < held.fraction() ? held.before() : held.after();
          const Vector3d felt = jacobian(parameters, *there)->linear.transpose().partialPivLu().solve(torque);
          const double error = (felt + stiffness * depth_at(time)).norm();
          sum += error, largest = std::max(largest, error), ++samples;
        }
      const double unit = stiffness * speed / rate;
      BOOST_TEST_MESSAGE(rate << " Hz, delay " << delay << ": mean error " << sum / samples << " N, "
                              << sum / samples / unit << " k v T; largest " << largest / unit << " k v T");
      // J turns while the torque is held: a few per cent of the force of that moment more.
      BOOST_TEST(sum / samples <= unit * (0.5 + delay) * 1.1);
      BOOST_TEST(largest <= unit * (1 + delay) * 1.2);
    }
}

BOOST_AUTO_TEST_CASE(a_watchdog_sees_each_fault_and_nothing_else) {
  Random random(7);
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
  bad = reading, bad.torque[0] = -0.22;
  BOOST_TEST((fault(bad) == Loop_fault::torque));
  BOOST_TEST(!dog.check_condition(std::numeric_limits<double>::infinity()));
  BOOST_TEST((dog.fault() == Loop_fault::singular));
  dog.reset();
  reading.theta[0] += 1;
  BOOST_TEST(dog.check(reading));
}

BOOST_AUTO_TEST_CASE(percentiles_against_a_sorted_list) {
  Random random(8);
  for (int round = 0; round < 20; ++round) {
    Tick_statistics statistics;
    std::vector<std::uint64_t> all;
    for (int i = 0; i < 5000; ++i) {
      all.push_back(random() >> (random() % 64));
      statistics.add(all.back());
    }
    std::sort(all.begin(), all.end());
    BOOST_TEST(statistics.largest() == all.back());
    for (const double share : {0.01, 0.5, 0.99, 0.999, 0.9999, 1.0}) {
      const std::uint64_t exact = all[static_cast<std::size_t>(std::ceil(share * 5000)) - 1],
                          told = statistics.percentile(share);
      BOOST_TEST(told >= exact);
      BOOST_TEST(static_cast<double>(told) <= static_cast<double>(exact) * (1 + 1.0 / 32));
    }
  }
  BOOST_TEST(Tick_statistics().percentile(0.5) == 0u);
}

BOOST_AUTO_TEST_CASE(paths_are_read_or_refused_by_line_and_column) {
  const Hand_path path = Hand_path::parse("t,x,y,z,button\n0,0,0,0.1,0\r\n1,1e-2,-0.02,0.1,1\n", "p");
  BOOST_TEST((path.at(0.25).position - Vector3d(0.0025, -0.005, 0.1)).norm() <= 1e-17);
  BOOST_TEST((path.at(0.25).velocity - Vector3d(0.01, -0.02, 0)).norm() <= 1e-17);
  BOOST_TEST(path.at(0.99).button == 0);
  BOOST_TEST(path.at(1).button == 1);
  BOOST_TEST(path.at(7).velocity == Vector3d::Zero());
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
}

BOOST_AUTO_TEST_CASE(a_hand_comes_to_rest_where_it_wants_to_be) {
  const Hand_path path({{0, {0.004, 0.002, 0.136}, 0}});
  for (const Simulated_hand& hand : {Simulated_hand::finger(), Simulated_hand::arm()}) {
    const Device_parameters<double> parameters = device(Device_form::ditetrahedral, 0.005);
    Simulated_device simulated(parameters, *home_pose(parameters), hand, path, 0.001, 0);
    Handle_motion handle(parameters, *home_pose(parameters), 0.001);
    Force_renderer renderer(Force_limits(), Gravity_compensation::spatial, 0.001);
    for (int k = 0; k < 3000; ++k) {
      handle.follow(simulated.read().theta);
      const Rendered_force rendered = renderer.render(handle, Vector3d::Zero());
      simulated.write(rendered.torque, rendered.interaction_torque);
    }
    BOOST_TEST((simulated.state().pose.position - path.at(0).position).norm() <= 1e-4);
  }
}

} // namespace
