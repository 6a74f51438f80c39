// SPDX-License-Identifier: GPL-3.0-or-later
// Speed against error of the device's kinematics and dynamics, for four number types and for simpler models: ns per
// call beside the error against 60 digits.
#include "Benchmark_program.h"
#include "device/Mpfr_scalar.h"
#include "device/populations.h"
#include "device_speed_error/measure.h"

#include <CLI/CLI.hpp>

#include <iostream>

namespace {

using namespace device_populations;
using namespace haptic_sculpt::benchmark;
using nlohmann::json;

/// Configurations along a smooth path of the joints at 1 kHz, as a loop meets them, or random ones, as a planner does.
Population make_population(unsigned seed, int count, bool path) {
  Random random(seed);
  Population p;
  p.name = path ? "path" : "random";
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

} // namespace

int main(int argument_count, char** arguments) {
  CLI::App app(
      "Speed against error of the device's kinematics and dynamics for float, double, long double and MPFR numbers, "
      "and of simpler models");
  unsigned seed = 1;
  int count = 4096;
  app.add_option("--seed", seed, "of the random configurations");
  app.add_option("--count", count, "configurations")->check(positive_number);
  Benchmark_program program("device_speed_error", app, "number type, or all models, and population");
  return program.run(argument_count, arguments, [&](Promises&) {
    json rows = json::array(), models = json::array();
    for (bool along_a_path : {true, false}) {
      const Population p = make_population(seed, count, along_a_path);
      Population few = p;
      few.theta.resize(std::min<std::size_t>(few.theta.size(), 64));
      const auto unit = [&](const auto& work) {
        const std::size_t first = rows.size(), first_model = models.size(), number = program.shard.next_unit();
        if (program.shard.takes_next())
          work();
        for (std::size_t k = first; k < rows.size(); ++k)
          rows[k]["unit"] = number;
        for (std::size_t k = first_model; k < models.size(); ++k)
          models[k]["unit"] = number;
      };
      unit([&] { measure<float>("float", p, 500, 15, rows); });
      unit([&] { measure<double>("double", p, 500, 15, rows); });
      unit([&] { measure<long double>("long double", p, 500, 5, rows); });
      unit([&] { measure<Mpfr<34>>("MPFR 34", few, 64, 2, rows); });
      unit([&] { measure_models(p, 500, 15, models); });
    }
    return json{{"seed", seed}, {"count", count}, {"design", "D1"}, {"rows", rows}, {"models", models}};
  });
}
