// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device.h>
#include <random>

/// Random designs and joint angles, shared by tests and benchmarks.
namespace device_populations {

using namespace haptic_sculpt;
using Random = std::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline Device_description<double> random_design(Random& random, Device_form form) {
  Device_description<double> d;
  d.form = form;
  d.base_radius = uniform(random, 0.015, 0.05);
  d.primary_length = uniform(random, 0.05, 0.09);
  d.secondary_length = uniform(random, 0.07, 0.12);
  d.platform_radius = uniform(random, 0.01, 0.045);
  d.primary_mass = uniform(random, 0.002, 0.008);
  d.secondary_mass = uniform(random, 0.002, 0.008);
  d.platform_mass = uniform(random, 0.01, 0.04);
  d.rotor_inertia = uniform(random, 0, 1) < 0.5 ? 0 : 6.3e-5;
  d.platform_inertia = Device_description<double>::disc_inertia(d.platform_mass, d.platform_radius);
  return d;
}

inline Device_vector<double> random_angles(Random& random, double low, double high) {
  const double a = uniform(random, low, high), b = uniform(random, low, high), c = uniform(random, low, high);
  return Device_vector<double>(a, b, c);
}

inline Device_vector<double> random_vector(Random& random, double size) { return random_angles(random, -size, size); }

template <class S> Device_description<S> description_as(const Device_description<double>& d) {
  Device_description<S> e;
  e.form = d.form;
  e.base_radius = S(d.base_radius), e.primary_length = S(d.primary_length), e.secondary_length = S(d.secondary_length);
  e.platform_radius = S(d.platform_radius), e.primary_mass = S(d.primary_mass), e.secondary_mass = S(d.secondary_mass);
  e.platform_mass = S(d.platform_mass), e.rotor_inertia = S(d.rotor_inertia), e.gravity = S(d.gravity),
  e.torque_limit = S(d.torque_limit);
  e.viscous_friction = S(d.viscous_friction), e.coulomb_friction = S(d.coulomb_friction),
  e.encoder_step = S(d.encoder_step);
  for (int k = 0; k < 3; ++k)
    e.platform_inertia[k] = S(d.platform_inertia[k]), e.least_angle[k] = S(d.least_angle[k]),
    e.greatest_angle[k] = S(d.greatest_angle[k]);
  return e;
}

template <class S>
Device_vector<S> vector_as(const Device_vector<double>& v) {
  return Device_vector<S>(S(v[0]), S(v[1]), S(v[2]));
}

} // namespace device_populations
