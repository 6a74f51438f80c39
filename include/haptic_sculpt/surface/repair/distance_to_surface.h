// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/repair/nearest_point_tree.h>
#include <haptic_sculpt/surface/repair/Trail.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace haptic_sculpt::internal {

/// The largest distance of a point from the triangles of a soup, rounded; 0 if it has none. O((points + faces) log
/// faces) in the mean.
inline double farthest_from_surface(const std::vector<Decision_kernel::Point_3>& points, const Face_soup& soup) {
  using Triangles = std::vector<Decision_kernel::Triangle_3>;
  using Tree = Nearest_point_tree<Decision_kernel, Triangles::const_iterator>;
  // All by a power of two to at most 1 in size, whatever bits get lost: the distance is rounded anyway.
  double largest = 0;
  for (const auto* all : {&points, &soup.points})
    for (const auto& p : *all)
      largest = std::max({largest, std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
  const int exponent = largest > 0 ? std::ilogb(largest) + 1 : 0;
  const auto down = [exponent](const Decision_kernel::Point_3& p) {
    return Decision_kernel::Point_3(std::ldexp(p.x(), -exponent), std::ldexp(p.y(), -exponent),
                                    std::ldexp(p.z(), -exponent));
  };
  Triangles triangles;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    if (soup.number_of_corners(f) == 3)
      triangles.emplace_back(down(soup.points[soup.begin(f)[0]]), down(soup.points[soup.begin(f)[1]]),
                             down(soup.points[soup.begin(f)[2]]));
  double farthest = 0;
  if (triangles.empty())
    return farthest;
  const Tree tree(triangles.cbegin(), triangles.cend());
  for (const auto& p : points)
    farthest = std::max(farthest, distance_between(down(p), tree.closest_point(down(p))));
  return std::ldexp(farthest, exponent);
}

} // namespace haptic_sculpt::internal
