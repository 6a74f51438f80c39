// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Promises.h"

#include <haptic_sculpt/surface/io/replace_file.h>

#include <iostream>

namespace haptic_sculpt::benchmark {

constexpr int cannot_write = 5;

/// Where `file` names one, writes the report there, with the promises and the exit code at its end.
/// \return the exit code: that of the promises, or `cannot_write`, with the reason on standard error
inline int end_run(const std::string& program, const std::string& file, nlohmann::ordered_json report,
                   const Promises& promises) {
  report["promises"] = promises.json();
  report["exit"] = promises.exit();
  try {
    if (!file.empty())
      replace_file(file, report.dump(1) + '\n');
  } catch (const Error& error) {
    std::cerr << program << ": " << error.what() << '\n';
    return cannot_write;
  }
  return promises.exit();
}

} // namespace haptic_sculpt::benchmark
