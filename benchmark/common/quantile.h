// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace haptic_sculpt::benchmark {

/// The least value that at least the share q of all do not exceed: 0.5 the median, 1 the largest; 0 of none. In linear
/// time. Orders them anew.
inline double quantile(std::vector<double>& values, double q) {
  if (values.empty())
    return 0;
  const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size())));
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(rank, 1, values.size()) - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

} // namespace haptic_sculpt::benchmark
