// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>

namespace haptic_sculpt::benchmark {

/// The promises that a run has looked at, in the order of their weight. The exit code is that of the first broken one.
/// They are in the report, so that shares of a run can be added up and judged together.
class Promises {
public:
  /// \param asked how often it was looked at \param broken how often it was not kept
  /// \param may the share of `asked` that may be broken
  void add(int exit, const std::string& promise, std::size_t asked, std::size_t broken, double may = 0) {
    rows_.push_back({{"exit", exit}, {"promise", promise}, {"asked", asked}, {"broken", broken}, {"may", may}});
    if (exit_ == 0 && static_cast<double>(broken) > may * static_cast<double>(asked)) {
      exit_ = exit;
      first_broken_ = "broken: " + promise + ": " + std::to_string(broken) + " of " + std::to_string(asked) + " not";
    }
  }

  /// Cases that a full disk has not taken: they break no promise, and give the exit code where none is broken. \pre all
  /// promises are there
  void add_unwritten(int exit, std::size_t cases) {
    if (exit_ == 0 && cases != 0) {
      exit_ = exit;
      first_broken_ = std::to_string(cases) + " cases could not be written";
    }
  }

  /// 0 where all are kept.
  int exit() const { return exit_; }
  /// For people; empty where all are kept.
  const std::string& first_broken() const { return first_broken_; }
  const nlohmann::ordered_json& json() const { return rows_; }

private:
  nlohmann::ordered_json rows_ = nlohmann::ordered_json::array();
  int exit_ = 0;
  std::string first_broken_;
};

} // namespace haptic_sculpt::benchmark
