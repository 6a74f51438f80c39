// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Run_result.h"

#include <algorithm>

namespace haptic_sculpt::sculpt_program {

/// Those nearest to a point, nearest first, of equally near ones the first; decided exactly.
/// \param numbers of vertices, in growing order \param point_of(number) where it is \param most how many are wanted
template <class Point_of>
std::vector<std::size_t> nearest_vertices(std::vector<std::size_t> numbers, const Point_of& point_of,
                                          const Kernel::Point_3& to, std::size_t most) {
  most = std::min(most, numbers.size());
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(most);
  std::partial_sort(numbers.begin(), middle, numbers.end(), [&](std::size_t a, std::size_t b) {
    const CGAL::Comparison_result order = Kernel().compare_distance_3_object()(to, point_of(a), point_of(b));
    return order == CGAL::SMALLER || (order == CGAL::EQUAL && a < b);
  });
  numbers.resize(most);
  return numbers;
}

} // namespace haptic_sculpt::sculpt_program
