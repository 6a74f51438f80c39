// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Aabb_traits.h>

#include <CGAL/AABB_tree.h>

#include <algorithm>
#include <cmath>

namespace haptic_sculpt::internal {

/// The nearest point of a triangle, rounded: CGAL's, where that is a number. It divides by the square of a normal,
/// which of a thin triangle may be 0 as a double; and on what is no number GMP ends the process.
template <class Kernel>
struct Nearest_point_of_triangle {
  using Point_3 = typename Kernel::Point_3;
  using Vector_3 = typename Kernel::Vector_3;
  using Triangle_3 = typename Kernel::Triangle_3;

  Point_3 operator()(const Triangle_3& triangle, const Point_3& p) const {
    const Point_3 nearest = Kernel().construct_projected_point_3_object()(triangle, p);
    const bool is_number = std::isfinite(nearest.x()) && std::isfinite(nearest.y()) && std::isfinite(nearest.z());
    return is_number ? nearest : of_edges(triangle, p);
  }

private:
  /// Of a triangle without a width.
  static Point_3 of_edges(const Triangle_3& triangle, const Point_3& p) {
    Point_3 nearest = of_segment(triangle[0], triangle[1], p);
    for (const Point_3& q : {of_segment(triangle[1], triangle[2], p), of_segment(triangle[2], triangle[0], p)})
      if (distance(p, q) < distance(p, nearest))
        nearest = q;
    return nearest;
  }
  static double distance(const Point_3& p, const Point_3& q) {
    return std::hypot(p.x() - q.x(), p.y() - q.y(), p.z() - q.z());
  }
  static Point_3 of_segment(const Point_3& a, const Point_3& b, const Point_3& p) {
    const double share = (p - a) * (b - a) / (b - a).squared_length();
    return share > 0 ? a + std::min(share, 1.0) * (b - a) : a; // `a` too where there is no share
  }
};

/// What an AABB tree asks of a kernel, with that in place of CGAL's.
template <class Kernel>
struct Nearest_point_kernel : Kernel {
  using Construct_projected_point_3 = Nearest_point_of_triangle<Kernel>;
  Construct_projected_point_3 construct_projected_point_3_object() const { return {}; }
};

/// CGAL's tree over triangles, for nearest points. \pre coordinates whose squares are in the range of doubles
template <class Kernel, class Triangle_iterator>
using Nearest_point_tree = CGAL::AABB_tree<
    Aabb_traits<Nearest_point_kernel<Kernel>, Aabb_triangle<Nearest_point_kernel<Kernel>, Triangle_iterator>>>;

} // namespace haptic_sculpt::internal
