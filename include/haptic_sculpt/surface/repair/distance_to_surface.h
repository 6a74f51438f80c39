// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/repair/Trail.h>

#include <CGAL/AABB_tree.h>
#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <vector>

namespace haptic_sculpt::internal {

/// The largest distance of a point from the triangles of a soup, rounded; 0 if it has none. O((points + faces) log
/// faces) in the mean.
inline double farthest_from_surface(const std::vector<Decision_kernel::Point_3>& points, const Face_soup& soup) {
  using Triangles = std::vector<Decision_kernel::Triangle_3>;
#if CGAL_VERSION_NR >= 1060000000
  using Primitive = CGAL::AABB_triangle_primitive_3<Decision_kernel, Triangles::const_iterator>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits_3<Decision_kernel, Primitive>>;
#else
  using Primitive = CGAL::AABB_triangle_primitive<Decision_kernel, Triangles::const_iterator>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Decision_kernel, Primitive>>;
#endif
  Triangles triangles;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    if (soup.number_of_corners(f) == 3)
      if (const Decision_kernel::Triangle_3 t(soup.points[soup.begin(f)[0]], soup.points[soup.begin(f)[1]],
                                              soup.points[soup.begin(f)[2]]);
          !t.is_degenerate())
        triangles.push_back(t);
  double farthest = 0;
  if (triangles.empty())
    return farthest;
  const Tree tree(triangles.cbegin(), triangles.cend());
  for (const auto& p : points)
    farthest = std::max(farthest, distance_between(p, tree.closest_point(p)));
  return farthest;
}

} // namespace haptic_sculpt::internal
