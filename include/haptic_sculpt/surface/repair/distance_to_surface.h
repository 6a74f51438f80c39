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

#include <algorithm>
#include <cmath>
#include <vector>

namespace haptic_sculpt::internal {

/// The nearest point of a triangle, rounded, and never NaN: CGAL's own divides by the square of a normal, which of a
/// thin triangle may be 0 as a double. \pre coordinates are at most 1 in size
struct Nearest_point_of_triangle {
  using Point_3 = Decision_kernel::Point_3;
  using Vector_3 = Decision_kernel::Vector_3;

  Point_3 operator()(const Decision_kernel::Triangle_3& triangle, const Point_3& p) const {
    const Point_3 &a = triangle[0], &b = triangle[1], &c = triangle[2];
    Point_3 nearest = of_segment(a, b, p);
    const auto take = [&](const Point_3& q) {
      if (distance_between(p, q) < distance_between(p, nearest))
        nearest = q;
    };
    take(of_segment(b, c, p));
    take(of_segment(c, a, p));
    const Vector_3 normal = CGAL::cross_product(b - a, c - a);
    if (const double squared = normal.squared_length(); squared > 0) {
      const double v = CGAL::cross_product(p - a, c - a) * normal / squared,
                   w = CGAL::cross_product(b - a, p - a) * normal / squared;
      if (v >= 0 && w >= 0 && v + w <= 1)
        take(a + v * (b - a) + w * (c - a));
    }
    return nearest;
  }

private:
  static Point_3 of_segment(const Point_3& a, const Point_3& b, const Point_3& p) {
    const double squared = (b - a).squared_length();
    return squared > 0 ? a + std::clamp((p - a) * (b - a) / squared, 0.0, 1.0) * (b - a) : a;
  }
};

/// What an AABB tree asks of a kernel, with that in place of CGAL's.
struct Nearest_point_kernel : Decision_kernel {
  using Construct_projected_point_3 = Nearest_point_of_triangle;
  Construct_projected_point_3 construct_projected_point_3_object() const { return {}; }
};

/// The largest distance of a point from the triangles of a soup, rounded; 0 if it has none. O((points + faces) log
/// faces) in the mean.
inline double farthest_from_surface(const std::vector<Decision_kernel::Point_3>& points, const Face_soup& soup) {
  using Triangles = std::vector<Decision_kernel::Triangle_3>;
#if CGAL_VERSION_NR >= 1060000000
  using Primitive = CGAL::AABB_triangle_primitive_3<Nearest_point_kernel, Triangles::const_iterator>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits_3<Nearest_point_kernel, Primitive>>;
#else
  using Primitive = CGAL::AABB_triangle_primitive<Nearest_point_kernel, Triangles::const_iterator>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Nearest_point_kernel, Primitive>>;
#endif
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
