// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Query_timer.h"
#include "quantile.h"

#include <nlohmann/json.hpp>

namespace haptic_sculpt::benchmark {

using Json = nlohmann::ordered_json;

inline const Query_timer& timer() {
  static const Query_timer the_timer;
  return the_timer;
}

/// Times of single operations, in nanoseconds, the timer's own time taken off.
class Latencies {
public:
  /// Runs and times one operation; returns what it returns.
  template <class Operation>
  auto measure(const Operation& operation) {
    const std::uint64_t start = Query_timer::now();
    if constexpr (std::is_void<decltype(operation())>::value) {
      operation();
      add(start);
    } else {
      auto result = operation();
      add(start);
      return result;
    }
  }

  void add_nanoseconds(double time) { times_.push_back(time); }
  double last() const { return times_.back(); }
  std::size_t size() const { return times_.size(); }
  void reserve(std::size_t size) { times_.reserve(size); }

  double median() { return quantile(times_, 0.5); }

  /// Without the one per cent that took longest: other programs' time, mostly.
  double mean_of_most() {
    if (times_.empty())
      return 0;
    const double limit = quantile(times_, 0.99);
    double sum = 0, number = 0;
    for (const double t : times_)
      if (t <= limit)
        sum += t, ++number;
    return sum / number;
  }

  Json json() {
    if (times_.empty())
      return {{"count", 0}};
    double sum = 0;
    for (const double t : times_)
      sum += t;
    return {{"count", times_.size()},
            {"median_ns", quantile(times_, 0.5)},
            {"mean_ns", sum / static_cast<double>(times_.size())},
            {"p99_ns", quantile(times_, 0.99)},
            {"p999_ns", quantile(times_, 0.999)},
            {"max_ns", quantile(times_, 1)}};
  }

private:
  std::vector<double> times_;

  void add(std::uint64_t start) { times_.push_back(timer().nanoseconds(start, Query_timer::now())); }
};

} // namespace haptic_sculpt::benchmark
