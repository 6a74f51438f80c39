// SPDX-License-Identifier: GPL-3.0-or-later
// Virtual mass, and the mechanism's own that motors carry.
#include "haptic_rendering/devices_of_tests.h"

#include <haptic_sculpt/haptic_rendering/Force_renderer.h>
#include <haptic_sculpt/haptic_rendering/Inertia_rendering.h>
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
  Inertia_parameters wanted;
  wanted.mass = mass, wanted.cutoff = cutoff;
  Inertia_rendering inertia(wanted, parameters, 1 / rate, 0);
  Force_renderer renderer(no_limits(), Virtual_coupling(), Gravity_compensation::none, 1 / rate);
  Device_pose<double> pose = *home;
  const double settled = 0.5, periods = std::max(1.0, std::floor(frequency)), end = settled + periods / frequency;
  double square = 0, all = 0, largest = 0;
  for (int k = 0; k / rate < end; ++k) {
    const double t = k / rate;
    pose = *reach_position(parameters, pose, Vector3d(home->position + amplitude * std::sin(omega * t) * direction));
    handle.follow(pose.theta);
    const Vector3d force = renderer.render(handle, inertia.force(handle, true)).force;
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
  Inertia_parameters wanted;
  wanted.mass = mass;
  Inertia_rendering inertia(wanted, parameters, 1 / rate, 0);
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
    const Vector3d force = inertia.force(handle, is_grabbed);
    if (k < 100 || k >= 351)
      BOOST_TEST(force == Vector3d::Zero());
    BOOST_TEST((force - last).norm() <= mass * 0.8 * (1 / (rate * Inertia_rendering::fade_time) + 0.03));
    last = force;
    if (k == 299)
      kinetic = mass * std::pow(0.005 * omega * std::sin(omega * t), 2) / 2;
  }
  BOOST_TEST(std::abs(inertia.mass_energy() - energy) <= 5e-3 * std::abs(energy));
  BOOST_TEST(std::abs(energy) > 1e-6);
  BOOST_TEST(kinetic > 0);
  Inertia_parameters bad;
  bad.mass = -1;
  BOOST_CHECK_THROW(Inertia_rendering(bad, parameters, 0.001, 0), Error);
  bad.mass = 0, bad.compensated = 1.5;
  BOOST_CHECK_THROW(Inertia_rendering(bad, parameters, 0.001, 0), Error);
  bad.compensated = 0.5, bad.cutoff = 0;
  BOOST_CHECK_THROW(Inertia_rendering(bad, parameters, 0.001, 0), Error);
}

/// The force that a hand gives to lead the handle along a sinusoid: the mechanism's own inertia and friction, less what
/// motors carry. Joint torques by inverse dynamics on the exact motion.
BOOST_AUTO_TEST_CASE(compensated_inertia_is_not_felt) {
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    Device_description<double> description = named_design<double>(Named_design::D1, form);
    description.gravity = 0;
    const Device_parameters<double> parameters(description);
    const auto home = home_pose(parameters);
    const double rate = 1000, omega = 2 * M_PI * 4;
    for (const double share : {0.5, 0.8}) {
      Handle_motion handle(parameters, *home, 1 / rate);
      Inertia_parameters wanted;
      wanted.compensated = share;
      Inertia_rendering inertia(wanted, parameters, 1 / rate, 0);
      double square = 0, all = 0;
      for (int k = 0; k < 1000; ++k) {
        const double t = k / rate;
        const Vector3d swing = 0.1 * Vector3d(1, -0.4, 0.6);
        const auto pose = forward_kinematics(parameters, Vector3d(home->theta + swing * std::sin(omega * t)), *home);
        handle.follow(pose->theta);
        const Vector3d force = inertia.force(handle, false);
        if (k < 200)
          continue;
        const auto torque = spatial_inverse_dynamics(parameters, *pose, Vector3d(swing * omega * std::cos(omega * t)),
                                                     Vector3d(-swing * omega * omega * std::sin(omega * t)));
        const Vector3d exact = share * torque->torque;
        square += (handle.jacobian().linear.transpose() * force - exact).squaredNorm(), all += exact.squaredNorm();
      }
      BOOST_TEST(std::sqrt(square / all) <= 0.02);
      BOOST_TEST(inertia.mass_energy() == 0);
      BOOST_TEST_MESSAGE("compensated inertia off by " << 100 * std::sqrt(square / all) << " %");
    }
  }
}

} // namespace
