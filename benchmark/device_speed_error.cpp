// SPDX-License-Identifier: GPL-3.0-or-later
// Speed against error of the device's kinematics and dynamics, for four number types: ns per call beside the error against 60 digits.
#include "device/Mpfr_scalar.h"
#include "device/populations.h"
#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

namespace {

using namespace device_populations;
using Exact = Mpfr<60>;
using nlohmann::json;

/// Configurations along a smooth path of the joints at 1 kHz, as a loop meets them, and random ones, as a planner does.
struct Population {
  std::vector<Device_vector<double>> theta, rate, acceleration;
};

Population make_population(unsigned seed, int count, bool path) {
  Random random(seed);
  Population p;
  const Device_vector<double> phase = random_vector(random, 3);
  for (int k = 0; k < count; ++k) {
    const double t = 1e-3 * k;
    Device_vector<double> theta = random_angles(random, 0.6, 1.4);
    if (path)
      for (int leg = 0; leg < 3; ++leg)
        theta[leg] = 1 + 0.3 * std::sin((5 + leg) * t + phase[leg]);
    p.theta.push_back(theta);
    p.rate.push_back(random_vector(random, 5));
    p.acceleration.push_back(random_vector(random, 50));
  }
  return p;
}

template <class F> double nanoseconds_per_call(int count, int repetitions, const F& f) {
  double best = HUGE_VAL; // the least of several passes: what the code costs, not what else the machine was doing
  for (int pass = 0; pass < repetitions; ++pass) {
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < count; ++k)
      f(k);
    best = std::min(best, std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() / count);
  }
  return best;
}

template <class S> Exact exact(const S& value) { return Exact(value); }

template <class S> double relative_error(const Device_vector<S>& got, const Device_vector<Exact>& want, const Exact& scale) {
  Exact sum(0);
  for (int k = 0; k < 3; ++k)
    sum += (exact(got[k]) - want[k]) * (exact(got[k]) - want[k]);
  return static_cast<double>(Exact(sqrt(sum) / scale));
}

struct Errors {
  std::vector<double> values;
  json summary() {
    std::sort(values.begin(), values.end());
    if (values.empty())
      return {{"median", nullptr}, {"max", nullptr}};
    return {{"median", values[values.size() / 2]}, {"p99", values[values.size() * 99 / 100]}, {"max", values.back()}};
  }
};

volatile double sink;

/// Times and errors of one number type. Errors are divided by the condition number.
template <class S> void measure(const char* name, const Population& p, const char* population, int checked, int repetitions, json& rows) {
  const int count = static_cast<int>(p.theta.size());
  std::vector<Device_vector<S>> theta, rate, acceleration;
  for (int k = 0; k < count; ++k) {
    theta.push_back(vector_as<S>(p.theta[k])), rate.push_back(vector_as<S>(p.rate[k])), acceleration.push_back(vector_as<S>(p.acceleration[k]));
  }
  for (Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const bool general = form == Device_form::general;
    const Device_description<double> design = named_design<double>(Named_design::D1, form);
    const Device_parameters<S> parameters(description_as<S>(design));
    const Device_parameters<Exact> reference(description_as<Exact>(design));
    std::vector<Device_pose<S>> poses, near;
    for (int k = 0; k < count; ++k) {
      poses.push_back(*forward_kinematics(parameters, theta[k]));
      near.push_back(*forward_kinematics(parameters, Device_vector<S>(theta[k] + Device_vector<S>(S(0.002), S(-0.002), S(0.001)))));
    }
    auto row = [&](const char* what, double time, Errors errors) {
      json entry = {{"form", general ? "general" : "ditetra"}, {"what", what}, {"scalar", name}, {"population", population}, {"ns", time}, {"error_over_condition", errors.summary()}};
      const json& error = entry["error_over_condition"];
      std::printf("%-8s %-8s %-24s %-12s %10.1f ns", population, general ? "general" : "ditetra", what, name, time);
      if (error["median"].is_null())
        std::printf("   error not measured\n");
      else
        std::printf("   error / condition %9.2g median %9.2g max\n", error["median"].get<double>(), error["max"].get<double>());
      rows.push_back(entry);
    };
    Errors forward, inverse, dynamics_errors;
    for (int k = 0; k < std::min(checked, count); ++k) {
      // The reference solves the very numbers this type was given.
      Device_vector<Exact> angles, rates, accelerations;
      for (int i = 0; i < 3; ++i)
        angles[i] = exact(theta[k][i]), rates[i] = exact(rate[k][i]), accelerations[i] = exact(acceleration[k][i]);
      Device_parameters<Exact> same = reference;
      {
        Device_description<Exact> d = reference.description();
        const Device_description<S>& rounded = parameters.description();
        d.base_radius = exact(rounded.base_radius), d.primary_length = exact(rounded.primary_length), d.secondary_length = exact(rounded.secondary_length);
        d.platform_radius = exact(rounded.platform_radius), d.primary_mass = exact(rounded.primary_mass), d.secondary_mass = exact(rounded.secondary_mass);
        d.platform_mass = exact(rounded.platform_mass), d.gravity = exact(rounded.gravity), d.rotor_inertia = exact(rounded.rotor_inertia);
        for (int i = 0; i < 3; ++i)
          d.platform_inertia[i] = exact(rounded.platform_inertia[i]);
        if (violations(d).empty())
          same = Device_parameters<Exact>(d);
      }
      const auto truth = forward_kinematics(same, angles);
      const double condition = static_cast<double>(conditioning(parameters, poses[k])->constraint_condition);
      forward.values.push_back(relative_error<S>(poses[k].position, truth->position, same.secondary_length()) / condition);
      const auto torque = spatial_inverse_dynamics(same, *truth, rates, accelerations);
      const auto got = spatial_inverse_dynamics(parameters, poses[k], rate[k], acceleration[k]);
      dynamics_errors.values.push_back(relative_error<S>(got->torque, torque->torque, Exact(torque->torque.norm())) / condition);
      if (!general) {
        const Eigen::Vector3i knees = working_mode(parameters, poses[k]);
        const auto back = ditetrahedral_inverse(parameters, poses[k].position, knees);
        Device_vector<Exact> point;
        for (int i = 0; i < 3; ++i)
          point[i] = exact(poses[k].position[i]);
        const auto wanted = ditetrahedral_inverse(same, point, knees);
        inverse.values.push_back(relative_error<S>(back->theta, wanted->theta, Exact(1)));
      }
    }
    Eigen::Vector3i knees(0, 0, 0);
    if (!general) {
      row("forward", nanoseconds_per_call(count, repetitions, [&](int k) { sink = static_cast<double>(ditetrahedral_forward(parameters, theta[k], 1)->position[2]); }), forward);
      row("inverse, one knee mode", nanoseconds_per_call(count, repetitions, [&](int k) { sink = static_cast<double>(ditetrahedral_inverse(parameters, poses[k].position, knees)->theta[2]); }), inverse);
      row("inverse, all eight", nanoseconds_per_call(count, repetitions, [&](int k) { sink = static_cast<double>(ditetrahedral_inverse(parameters, poses[k].position)->plus[2]); }), inverse);
    } else {
      row("forward, warm", nanoseconds_per_call(count, repetitions, [&](int k) { sink = static_cast<double>(general_forward(parameters, theta[k], near[k])->position[2]); }), forward);
      row("forward, cold", nanoseconds_per_call(count, repetitions, [&](int k) { sink = static_cast<double>(general_forward(parameters, theta[k])->position[2]); }), forward);
    }
    row("Jacobian", nanoseconds_per_call(count, repetitions, [&](int k) { sink = static_cast<double>(jacobian(parameters, poses[k])->linear(2, 2)); }), {});
    row("inverse dynamics", nanoseconds_per_call(count, repetitions, [&](int k) { sink = static_cast<double>(spatial_inverse_dynamics(parameters, poses[k], rate[k], acceleration[k])->torque[2]); }), dynamics_errors);
  }
}

} // namespace

int main(int argument_count, char** arguments) {
  CLI::App app("Speed against error of the device's kinematics and dynamics for float, double, long double and MPFR numbers");
  std::string path;
  unsigned seed = 1;
  int count = 4096;
  app.add_option("--json", path, "write the results here");
  app.add_option("--seed", seed, "of the random configurations");
  app.add_option("--count", count, "configurations")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argument_count, arguments);
  json rows = json::array();
  for (bool along_a_path : {true, false}) {
    const Population p = make_population(seed, count, along_a_path);
    Population few = p;
    few.theta.resize(std::min<std::size_t>(few.theta.size(), 64));
    const char* name = along_a_path ? "path" : "random";
    measure<float>("float", p, name, 500, 15, rows);
    measure<double>("double", p, name, 500, 15, rows);
    measure<long double>("long double", p, name, 500, 5, rows);
    measure<Mpfr<34>>("MPFR 34", few, name, 64, 2, rows);
  }
  if (!path.empty()) {
    std::ofstream file(path);
    file << json{{"seed", seed}, {"count", count}, {"design", "D1"}, {"rows", rows}}.dump(1) << '\n';
    if (!file) {
      std::cerr << "cannot write " << path << '\n';
      return 1;
    }
  }
}
