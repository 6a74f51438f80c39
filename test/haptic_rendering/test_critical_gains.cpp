// SPDX-License-Identifier: GPL-3.0-or-later
// The mass and the damping from which a free handle swings by itself, and that more than serves is refused.
#include "haptic_rendering/devices_of_tests.h"

#include <haptic_sculpt/haptic_rendering/check_coupling.h>
#include <haptic_sculpt/haptic_rendering/critical_gains.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace haptic_sculpt;
using namespace haptic_rendering_tests;

namespace {

BOOST_AUTO_TEST_CASE(estimates_respond_to_sinusoids_as_they_say) {
  for (const double tick : {0.0001, 0.001, 0.004})
    for (const double cutoff : {30.0, 100.0})
      for (const double angle : {0.01, 0.3, 1.5, 3.0}) {
        Acceleration_estimate acceleration(tick, cutoff);
        Velocity_estimate velocity(tick, cutoff);
        const auto at = [&](int k) { return std::polar(1.0, angle * k); };
        std::complex<double> wanted_a, wanted_v;
        double a = 0, v = 0;
        for (int k = 0; k < 4000; ++k) {
          const Vector3d step(at(k).real(), 0, 0);
          a = acceleration.add(step)[0], v = velocity.add(step)[0];
          wanted_a = acceleration.response(angle) * (at(k) - at(k - 1)) / (tick * tick);
          wanted_v = velocity.response(angle) * at(k) / tick;
        }
        BOOST_TEST(std::abs(a - wanted_a.real()) <= 1e-9 * std::abs(wanted_a));
        BOOST_TEST(std::abs(v - wanted_v.real()) <= 1e-9 * std::abs(wanted_v));
      }
}

/// A mass of 1 kg with viscous friction (N s/m), pushed once, under a force that follows its steps and its place and is
/// held from tick to tick, `delay` late.
/// \return by how much the force is larger in the end than soon after the push
template <class Force>
double growth(double tick, double delay, double friction, const Force& force) {
  const int whole = static_cast<int>(delay), ticks = 6000;
  const double late = delay - whole;
  std::vector<double> commands(static_cast<std::size_t>(whole) + 2, 0.0); // the latest first
  double place = 0, last = 0, velocity = 0, earlier = 0, later = 0;
  const auto go = [&](double newtons, double time) {
    if (friction == 0) {
      place += velocity * time + newtons * time * time / 2, velocity += newtons * time;
      return;
    }
    const double limit = newtons / friction, rest = (velocity - limit) * std::exp(-friction * time);
    place += limit * time + (velocity - limit - rest) / friction, velocity = limit + rest;
  };
  for (int k = 0; k < ticks; ++k) {
    std::rotate(commands.begin(), commands.end() - 1, commands.end());
    commands[0] = force(place - last, place) + (k == 0 ? 1 : 0);
    last = place;
    go(commands[static_cast<std::size_t>(whole) + 1], late * tick);
    go(commands[static_cast<std::size_t>(whole)], (1 - late) * tick);
    if (k >= 100 && k < 200)
      earlier = std::max(earlier, std::abs(commands[0]));
    if (k >= ticks - 100)
      later = std::max(later, std::abs(commands[0]));
  }
  return later / std::max(earlier, 1e-200);
}

BOOST_AUTO_TEST_CASE(a_free_mass_swings_by_itself_beyond_the_critical_gains_and_not_below) {
  Random random(haptic_sculpt::test::seed_from_environment(5));
  std::uniform_real_distribution<double> delays(0, 3), exponents(-4, -2.4);
  for (int round = 0; round < 40; ++round) {
    const double tick = std::pow(10, exponents(random)), delay = round % 2 == 0 ? round / 2 % 4 : delays(random);
    const double ratio = critical_mass_ratio(tick, delay, 100), rate = critical_damping_rate(tick, delay);
    const double raw = critical_damping_rate(tick, delay, std::numeric_limits<double>::infinity());
    for (const double share : {0.97, 1.03}) {
      Acceleration_estimate acceleration(tick);
      Velocity_estimate velocity(tick);
      const double mass = growth(tick, delay, 0, [&](double step, double) {
        return -share * ratio * acceleration.add(Vector3d(step, 0, 0))[0];
      });
      const double damper = growth(
          tick, delay, 0, [&](double step, double) { return -share * rate * velocity.add(Vector3d(step, 0, 0))[0]; });
      const double raw_damper = growth(tick, delay, 0, [&](double step, double) { return -share * raw * step / tick; });
      for (const double grown : {mass, damper, raw_damper})
        BOOST_TEST((grown < 1) == (share < 1),
                   "a share of " << share << " at T = " << tick << " s, d = " << delay << " grows by " << grown);
    }
  }
}

/// A mass of 1 kg that meets a wall with a damper in it. \param phase of the tick in which it meets it
/// \return its speed when it has left, over that with which it came; 0 if it stays
double thrown_off(double tick, double delay, double damping, double phase) {
  const int whole = static_cast<int>(delay);
  const double late = delay - whole;
  std::vector<double> commands(static_cast<std::size_t>(whole) + 2, 0.0); // the latest first
  Velocity_estimate velocity(tick);
  constexpr int before = 2000; // ticks, until the estimate has settled
  const double speed = 1;
  double depth = -(before + phase) * speed * tick, last = depth - speed * tick, now = speed;
  for (int k = 0; k < before + 20000; ++k) {
    const double told = velocity.add(Vector3d(depth - last, 0, 0))[0];
    std::rotate(commands.begin(), commands.end() - 1, commands.end());
    commands[0] = depth > 0 ? -damping * told : 0;
    last = depth;
    for (const auto& [newtons, time] : {std::pair(commands[static_cast<std::size_t>(whole) + 1], late * tick),
                                        std::pair(commands[static_cast<std::size_t>(whole)], (1 - late) * tick)})
      depth += now * time + newtons * time * time / 2, now += newtons * time;
    if (now < 0 && depth < 0 && std::all_of(commands.begin(), commands.end(), [](double f) { return f == 0; }))
      return -now / speed;
  }
  return 0;
}

BOOST_AUTO_TEST_CASE(the_largest_damping_throws_nothing_off_faster_than_it_came) {
  Random random(haptic_sculpt::test::seed_from_environment(7));
  std::uniform_real_distribution<double> delays(0, 2), exponents(-4, -2.4), phases(0, 1);
  double fastest = 0, fastest_of_thrice = 0;
  for (int round = 0; round < 300; ++round) {
    const double tick = std::pow(10, exponents(random)), delay = round % 2 == 0 ? round / 2 % 3 : delays(random);
    const double largest = largest_damping_rate(tick, delay), phase = phases(random);
    fastest = std::max(fastest, thrown_off(tick, delay, largest, phase));
    fastest_of_thrice = std::max(fastest_of_thrice, thrown_off(tick, delay, 3 * largest, phase));
  }
  BOOST_TEST_MESSAGE("thrown off at " << fastest << " of the speed, at thrice the damping " << fastest_of_thrice);
  BOOST_TEST(fastest <= 0.7);
  BOOST_TEST(fastest_of_thrice > 1);
}

BOOST_AUTO_TEST_CASE(what_is_larger_than_stable_is_refused_with_what_serves) {
  const Device_parameters<double> parameters = device(Device_form::ditetrahedral);
  const auto home = home_pose(parameters);
  const Workspace_map map(1, Vector3d::Zero(), Vector3d::Zero(), home->position);
  const Vector3d corner = Vector3d::Constant(0.02);
  const Passivity_limits limits = passivity_limits(parameters, Force_limits(), map, -corner, corner, 0, 0.001, 0);
  BOOST_TEST(limits.apparent_mass > 0.02);
  for (double x : {-0.019, 0.0, 0.019}) // no pose is lighter
    for (double y : {-0.019, 0.0, 0.019})
      for (double z : {-0.019, 0.0, 0.019}) {
        const auto pose = reach_position(parameters, *home, home->position + Vector3d(x, y, z));
        const auto terms = dynamics(parameters, Dynamics_model::spatial, *pose, Vector3d(0, 0, 0));
        const Eigen::Matrix3d mass = apparent_mass(terms->mass, jacobian(parameters, *pose)->linear);
        for (const Vector3d& way : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1), Vector3d(0.6, 0, 0.8)})
          BOOST_TEST(way.dot(mass * way) >= limits.apparent_mass);
      }
  const auto check = [&](double damping, double mass, double controller) {
    check_dynamics(damping, mass, controller, limits);
  };
  check(limits.largest_damping, limits.largest_mass, limits.largest_controller);
  const auto names = [](const char* what, double largest) {
    return [=](const Unstable_coupling& error) {
      const std::string text = error.what();
      return text.find(what) != std::string::npos && text.find(internal::number(largest)) != std::string::npos;
    };
  };
  BOOST_CHECK_EXCEPTION(check(1.001 * limits.largest_damping, 0, 0), Unstable_coupling,
                        names("the damping", limits.largest_damping));
  BOOST_CHECK_EXCEPTION(check(0, 1.001 * limits.largest_mass, 0), Unstable_coupling,
                        names("virtual mass", limits.largest_mass));
  BOOST_CHECK_EXCEPTION(check(0, 0, 1.001 * limits.largest_controller), Unstable_coupling,
                        names("controller", limits.largest_controller));
}

} // namespace
