// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/leg_frame.h>

#include <nlohmann/json.hpp>

#include <vector>

namespace haptic_sculpt::benchmark {

struct Population {
  const char* name;
  std::vector<Device_vector<double>> theta, rate, acceleration;
};

/// Times and errors of one number type on one population; errors are divided by the condition number.
///
/// \param checked this many configurations are compared with the reference \param repetitions passes, of which the
/// fastest counts \param rows where the results go, beside standard output
template <class S>
void measure(const char* scalar, const Population& population, int checked, int repetitions, nlohmann::json& rows);

/// The same of simpler models, in doubles: relative errors, of torques by their size, of positions by the length of a
/// secondary link. \param rows another list
void measure_models(const Population& population, int checked, int repetitions, nlohmann::json& rows);

} // namespace haptic_sculpt::benchmark
