// SPDX-License-Identifier: GPL-3.0-or-later
// Virtual mass.
#include "haptic_rendering/devices_of_tests.h"

#include <haptic_sculpt/haptic_rendering/Force_renderer.h>
#include <haptic_sculpt/haptic_rendering/Pose_loop.h>
#include <haptic_sculpt/haptic_rendering/Virtual_mass.h>
#include <haptic_sculpt/haptic_rendering/reach_position.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

using namespace haptic_sculpt;
using namespace haptic_rendering_tests;

namespace {

/// The handle is led along a sinusoid; F is compared with -m a as complex amplitudes: size and phase.
double error_of_mass(const Device_parameters<double>& parameters, double rate, double frequency, double cutoff) {
  const double omega = 2 * M_PI * frequency, amplitude = 0.004, mass = 0.05;
  const auto home = home_pose(parameters);
  const Vector3d direction = Vector3d(0.3, -0.5, 0.8).normalized();
  Handle_motion handle(parameters, *home, 1 / rate);
  Virtual_mass_parameters wanted;
  wanted.mass = mass, wanted.cutoff = cutoff;
  Virtual_mass inertia(wanted, 1 / rate, 0);
  Force_renderer renderer(no_limits(), Virtual_coupling(), Gravity_compensation::none, 1 / rate);
  Device_pose<double> pose = *home;
  const double settled = 0.5, periods = std::max(1.0, std::floor(frequency)), end = settled + periods / frequency;
  double square = 0, all = 0, largest = 0;
  for (int k = 0; k / rate < end; ++k) {
    const double t = k / rate;
    pose = *reach_position(parameters, pose, Vector3d(home->position + amplitude * std::sin(omega * t) * direction));
    handle.follow(pose.theta);
    const Vector3d force = renderer.render(handle, inertia.force(handle.step(), 1 / rate, true)).force;
    const Vector3d exact = mass * amplitude * omega * omega * std::sin(omega * t) * direction;
    if (t < settled)
      continue;
    square += (force - exact).squaredNorm(), all += exact.squaredNorm();
    largest = std::max(largest, (force - exact).norm() / (mass * amplitude * omega * omega));
  }
  BOOST_TEST(largest <= 2 * std::sqrt(square / all) + 1e-3); // an error of size and phase alone, no spikes
  return std::sqrt(square / all);
}

BOOST_AUTO_TEST_CASE(a_virtual_mass_resists_acceleration_in_size_and_phase) {
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general})
    for (const double rate : {250.0, 500.0, 1000.0, 4000.0, 10000.0}) {
      double worst = 0;
      for (const double frequency : {0.5, 1.0, 2.0, 3.5, 5.0})
        worst = std::max(worst, error_of_mass(device(form), rate, frequency, Acceleration_estimate::default_cutoff));
      BOOST_TEST_MESSAGE(rate << " Hz: virtual mass off by at most " << 100 * worst << " % of m a, to 5 Hz");
      BOOST_TEST(worst <= 0.01);
    }
}

BOOST_AUTO_TEST_CASE(a_virtual_mass_comes_and_goes_and_its_energy_is_told) {
  const Device_parameters<double> parameters = device(Device_form::ditetrahedral);
  const auto home = home_pose(parameters);
  const double rate = 1000, mass = 0.05;
  Handle_motion handle(parameters, *home, 1 / rate);
  Virtual_mass_parameters wanted;
  wanted.mass = mass;
  Virtual_mass inertia(wanted, 1 / rate, 0);
  Device_pose<double> pose = *home;
  Vector3d last = Vector3d::Zero();
  double energy = 0, kinetic = 0;
  for (int k = 0; k < 400; ++k) { // grabbed at 100, in motion; let go at 300
    const double t = k / rate, omega = 2 * M_PI * 2;
    const auto next =
        reach_position(parameters, pose, Vector3d(home->position + Vector3d(0, 0, 0.005 * (1 - std::cos(omega * t)))));
    energy -= last.dot(next->position - pose.position);
    pose = *next;
    handle.follow(pose.theta);
    const bool is_grabbed = k >= 100 && k < 300;
    const Vector3d force = inertia.force(handle.step(), 1 / rate, is_grabbed);
    if (k < 100 || k >= 351)
      BOOST_TEST(force == Vector3d::Zero());
    BOOST_TEST((force - last).norm() <= mass * 0.8 * (1 / (rate * Virtual_mass::fade_time) + 0.03));
    last = force;
    if (k == 299)
      kinetic = mass * std::pow(0.005 * omega * std::sin(omega * t), 2) / 2;
  }
  BOOST_TEST(std::abs(inertia.energy() - energy) <= 5e-3 * std::abs(energy));
  BOOST_TEST(std::abs(energy) > 1e-6);
  BOOST_TEST(kinetic > 0);
  Virtual_mass_parameters bad;
  bad.mass = -1;
  BOOST_CHECK_THROW(Virtual_mass(bad, 0.001, 0), Error);
  bad.mass = 0.5, bad.cutoff = 0;
  BOOST_CHECK_THROW(Virtual_mass(bad, 0.001, 0), Error);
}

BOOST_AUTO_TEST_CASE(a_virtual_mass_is_the_same_on_a_device_of_pose_and_force) {
  const double omega = 2 * M_PI * 2, amplitude = 0.004;
  Pose_loop_parameters parameters(5);
  parameters.virtual_mass.mass = 0.9 * parameters.largest_mass();
  const Haptic_parameters all = parameters.checked();
  Interaction<Pose_side> loop(Pose_side(parameters.device, all), all, 0);
  const Vector3d direction = Vector3d(0.3, -0.5, 0.8).normalized();
  double worst = 0;
  for (int k = 0; k < 2000; ++k) {
    const double t = k * all.tick;
    Pose_reading reading;
    reading.position = amplitude * std::sin(omega * t) * direction, reading.elapsed = all.tick;
    BOOST_REQUIRE(loop.follow(reading));
    Touch touch;
    touch.holds = true;
    loop.render(touch), loop.end_tick();
    const Vector3d exact = parameters.virtual_mass.mass * amplitude * omega * omega * std::sin(omega * t) * direction;
    if (t > 0.5)
      worst = std::max(worst, (loop.wanted() - exact).norm());
  }
  BOOST_TEST(parameters.virtual_mass.mass > 0.01);
  BOOST_TEST(worst <= 0.01 * parameters.virtual_mass.mass * amplitude * omega * omega);
}

// What a hand has put into it comes back when it brakes, and is no energy of the device's own.
BOOST_AUTO_TEST_CASE(a_heavy_virtual_mass_that_may_be_asked_for_ends_no_run) {
  Pose_loop_parameters parameters(0.5);
  parameters.device.mass = 1;
  parameters.virtual_mass.mass = 0.5;
  BOOST_REQUIRE(parameters.virtual_mass.mass <= parameters.largest_mass());
  const Haptic_parameters all = parameters.checked();
  Interaction<Pose_side> loop(Pose_side(parameters.device, all), all, 0);
  double x = 0, held = 0;
  for (int k = 0; k < 2000; ++k) {
    const double t = std::fmod(k * all.tick, 0.6), speed = std::fmax(0, 0.8 * (1 - std::abs(t - 0.3) / 0.15)); // m/s
    x += speed * all.tick;
    Pose_reading reading;
    reading.position = Vector3d(x, 0, 0), reading.elapsed = all.tick;
    BOOST_REQUIRE(loop.follow(reading));
    Touch touch;
    touch.holds = true;
    loop.render(touch), loop.end_tick();
    held = std::max(held, loop.virtual_mass().held_energy(loop.side().velocity()));
  }
  BOOST_TEST((loop.fault() == Loop_fault::none));
  BOOST_TEST(held > 0.14);
  BOOST_TEST(held < 0.17);
}

BOOST_AUTO_TEST_CASE(after_a_fault_a_virtual_mass_comes_back_as_slowly_as_at_a_start) {
  const double omega = 2 * M_PI * 2, amplitude = 0.004;
  Pose_loop_parameters parameters(5);
  parameters.virtual_mass.mass = 0.9 * parameters.largest_mass();
  const Haptic_parameters all = parameters.checked();
  const auto started = [&] { return Interaction<Pose_side>(Pose_side(parameters.device, all), all, 0); };
  const auto tick = [&](Interaction<Pose_side>& loop, double x) {
    Pose_reading reading;
    reading.position[0] = x, reading.elapsed = all.tick;
    if (Touch touch; loop.follow(reading)) {
      touch.holds = true;
      loop.render(touch);
    }
    loop.end_tick();
    return loop.rendered().force;
  };
  const auto place = [&](int k) { return amplitude * std::cos(omega * k * all.tick); }; // accelerated most at k = 0
  const double whole = parameters.virtual_mass.mass * amplitude * omega * omega;
  Interaction<Pose_side> loop = started(), fresh = started();
  double felt = 0;
  for (int k = 0; k < 1000; ++k)
    felt = std::max(felt, tick(loop, place(k)).norm());
  BOOST_TEST(felt > 0.95 * whole);
  for (int k = 0; k < 150; ++k)
    tick(loop, NAN);
  BOOST_REQUIRE((loop.fault() == Loop_fault::not_finite && loop.has_faded()));
  loop.restart();
  for (int k = 0; k < 1000; ++k) {
    const Vector3d force = tick(loop, place(k));
    BOOST_TEST(force == tick(fresh, place(k)));
    const double ramp = std::fmin(1, k * all.tick / all.limits.ramp_time + 0.005),
                 fade = std::fmin(1, k * all.tick / Virtual_mass::fade_time); // 1.2: the estimate overshoots
    BOOST_TEST(force.norm() <= 1.2 * whole * ramp * fade + 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(uneven_and_late_ticks_at_constant_speed_make_no_force_of_a_virtual_mass) {
  Pose_loop_parameters parameters(5);
  parameters.virtual_mass.mass = 0.5 * parameters.largest_mass();
  const Haptic_parameters all = parameters.checked();
  Interaction<Pose_side> loop(Pose_side(parameters.device, all), all, 0);
  double t = 0, worst = 0;
  for (int k = 0; k < 1000; ++k) {
    Pose_reading reading;
    reading.elapsed = all.tick * (k % 200 == 199 ? 15 : k % 2 == 0 ? 1 : 0.6);
    t += reading.elapsed;
    reading.position = Vector3d(0.2 * t, 0, 0);
    BOOST_REQUIRE(loop.follow(reading));
    Touch touch;
    touch.holds = true;
    loop.render(touch), loop.end_tick();
    worst = std::max(worst, loop.wanted().norm());
  }
  BOOST_TEST(worst <= 1e-6);
}

} // namespace
