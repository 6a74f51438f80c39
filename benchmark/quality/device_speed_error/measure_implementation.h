// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "device/populations.h"
#include "device_speed_error/measure.h"
#include "device_speed_error/reference.h"
#include "../../common/quantile.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace haptic_sculpt::benchmark {
namespace measure_details {

template <class F>
double nanoseconds_per_call(int count, int repetitions, const F& f) {
  double best = HUGE_VAL; // the least of several passes: what the code costs, not what else the machine was doing
  for (int pass = 0; pass < repetitions; ++pass) {
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < count; ++k)
      f(k);
    best = std::min(best,
                    std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() / count);
  }
  return best;
}

template <class S>
Device_vector<Exact> exact(const Device_vector<S>& v) {
  return {Exact(v[0]), Exact(v[1]), Exact(v[2])};
}

/// The very numbers of this type.
template <class S>
Device_description<Exact> exact(const Device_description<S>& rounded) {
  Device_description<Exact> d;
  d.form = rounded.form;
  d.base_radius = Exact(rounded.base_radius), d.primary_length = Exact(rounded.primary_length),
  d.secondary_length = Exact(rounded.secondary_length);
  d.platform_radius = Exact(rounded.platform_radius), d.primary_mass = Exact(rounded.primary_mass),
  d.secondary_mass = Exact(rounded.secondary_mass);
  d.platform_mass = Exact(rounded.platform_mass), d.gravity = Exact(rounded.gravity),
  d.rotor_inertia = Exact(rounded.rotor_inertia);
  for (int i = 0; i < 3; ++i)
    d.platform_inertia[i] = Exact(rounded.platform_inertia[i]);
  return d;
}

template <class S>
double relative_error(const Device_vector<S>& got, const Device_vector<Exact>& want, const Exact& scale) {
  return static_cast<double>(Exact((exact(got) - want).norm() / scale));
}

struct Errors {
  std::vector<double> values;
  nlohmann::json summary() {
    if (values.empty())
      return {{"median", nullptr}, {"max", nullptr}};
    const auto at = [this](double share) { return quantile(values, share); };
    return {{"median", at(0.5)}, {"p99", at(0.99)}, {"max", at(1)}};
  }
};

inline volatile double sink;

} // namespace measure_details

template <class S>
void measure(const char* name, const Population& p, int checked, int repetitions, nlohmann::json& rows) {
  using namespace device_populations;
  using namespace measure_details;
  using nlohmann::json;
  const int count = static_cast<int>(p.theta.size());
  std::vector<Device_vector<S>> theta, rate, acceleration;
  for (int k = 0; k < count; ++k) {
    theta.push_back(vector_as<S>(p.theta[k])), rate.push_back(vector_as<S>(p.rate[k])),
        acceleration.push_back(vector_as<S>(p.acceleration[k]));
  }
  for (Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const bool general = form == Device_form::general;
    const Device_description<double> design = named_design<double>(Named_design::D1, form);
    const Device_parameters<S> parameters(description_as<S>(design));
    std::vector<Device_pose<S>> poses, near;
    for (int k = 0; k < count; ++k) {
      poses.push_back(*forward_kinematics(parameters, theta[k]));
      near.push_back(*forward_kinematics(parameters,
                                         Device_vector<S>(theta[k] + Device_vector<S>(S(0.002), S(-0.002), S(0.001)))));
    }
    auto row = [&](const char* what, double time, Errors errors) {
      json entry = {{"form", general ? "general" : "ditetra"},
                    {"what", what},
                    {"scalar", name},
                    {"population", p.name},
                    {"ns", time},
                    {"error_over_condition", errors.summary()}};
      const json& error = entry["error_over_condition"];
      std::printf("%-8s %-8s %-24s %-12s %10.1f ns", p.name, general ? "general" : "ditetra", what, name, time);
      if (error["median"].is_null())
        std::printf("   error not measured\n");
      else
        std::printf("   error / condition %9.2g median %9.2g max\n", error["median"].get<double>(),
                    error["max"].get<double>());
      rows.push_back(entry);
    };
    Errors forward, warm, inverse, all_inverses, dynamics_errors;
    const Reference reference(exact(parameters.description()), description_as<Exact>(design));
    for (int k = 0; k < std::min(checked, count); ++k) {
      const auto truth = reference.state(exact(theta[k]), exact(rate[k]), exact(acceleration[k]));
      const double condition = static_cast<double>(conditioning(parameters, poses[k])->constraint_condition);
      forward.values.push_back(relative_error(poses[k].position, truth.position, reference.secondary_length()) /
                               condition);
      if (general)
        warm.values.push_back(relative_error(general_forward(parameters, theta[k], near[k])->position, truth.position,
                                             reference.secondary_length()) /
                              condition);
      const auto got = spatial_inverse_dynamics(parameters, poses[k], rate[k], acceleration[k]);
      dynamics_errors.values.push_back(relative_error(got->torque, truth.torque, Exact(truth.torque.norm())) /
                                       condition);
      if (!general) {
        const Eigen::Vector3i knees = working_mode(parameters, poses[k]);
        const auto back = ditetrahedral_inverse(parameters, poses[k].position, knees);
        const auto truth_of_it = reference.inverse(exact(poses[k].position), knees);
        inverse.values.push_back(relative_error(back->theta, truth_of_it, Exact(1)));
        const auto all = ditetrahedral_inverse(parameters, poses[k].position);
        Device_vector<S> of_knees;
        for (int i = 0; i < 3; ++i)
          of_knees[i] = (knees[i] == 0 ? all->minus : all->plus)[i];
        all_inverses.values.push_back(relative_error(of_knees, truth_of_it, Exact(1)));
      }
    }
    Eigen::Vector3i knees(0, 0, 0);
    if (!general) {
      row("forward",
          nanoseconds_per_call(
              count, repetitions,
              [&](int k) { sink = static_cast<double>(ditetrahedral_forward(parameters, theta[k], 1)->position[2]); }),
          forward);
      row("inverse, one knee mode",
          nanoseconds_per_call(count, repetitions,
                               [&](int k) {
                                 sink = static_cast<double>(
                                     ditetrahedral_inverse(parameters, poses[k].position, knees)->theta[2]);
                               }),
          inverse);
      row("inverse, all eight",
          nanoseconds_per_call(count, repetitions,
                               [&](int k) {
                                 sink =
                                     static_cast<double>(ditetrahedral_inverse(parameters, poses[k].position)->plus[2]);
                               }),
          all_inverses);
    } else {
      row("forward, warm",
          nanoseconds_per_call(
              count, repetitions,
              [&](int k) { sink = static_cast<double>(general_forward(parameters, theta[k], near[k])->position[2]); }),
          warm);
      row("forward, cold",
          nanoseconds_per_call(
              count, repetitions,
              [&](int k) { sink = static_cast<double>(general_forward(parameters, theta[k])->position[2]); }),
          forward);
    }
    row("Jacobian",
        nanoseconds_per_call(count, repetitions,
                             [&](int k) { sink = static_cast<double>(jacobian(parameters, poses[k])->linear(2, 2)); }),
        {});
    row("inverse dynamics",
        nanoseconds_per_call(count, repetitions,
                             [&](int k) {
                               sink = static_cast<double>(
                                   spatial_inverse_dynamics(parameters, poses[k], rate[k], acceleration[k])->torque[2]);
                             }),
        dynamics_errors);
  }
}

} // namespace haptic_sculpt::benchmark
