// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oracle/Sweep_kind.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>

namespace haptic_sculpt::test {

/// The verdict put together from CGAL's own predicates: what one does without this library.
/// Degenerate hulls, which `do_intersect` does not take, are distinguished first.
class Cgal_sweep {
public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point_3 = Kernel::Point_3;
  using Segment_3 = Kernel::Segment_3;
  using Triangle_3 = Kernel::Triangle_3;

  bool operator()(Sweep_kind kind, const std::array<Point_3, 5>& p) const {
    switch (kind) {
    case Sweep_kind::vertex_face: return meet(p[0], p[1], Triangle_3(p[2], p[3], p[4]));
    case Sweep_kind::edge_edge:
      if (CGAL::collinear(p[0], p[1], p[2]))
        return meet_collinear(p[0], p[1], p[2], Segment_3(p[3], p[4]));
      return CGAL::do_intersect(Triangle_3(p[0], p[1], p[2]), Segment_3(p[3], p[4]));
    default: return is_in_tetrahedron(p);
    }
  }

private:
  static bool meet(const Point_3& s, const Point_3& t, const Triangle_3& triangle) {
    return s == t ? triangle.has_on(s) : CGAL::do_intersect(Segment_3(s, t), triangle);
  }

  static bool meet_collinear(const Point_3& s, const Point_3& t, const Point_3& v, const Segment_3& segment) {
    const auto [low, high] = std::minmax({s, t, v}); // in lexicographic order
    return low == high ? segment.has_on(low) : CGAL::do_intersect(Segment_3(low, high), segment);
  }

  static bool is_in_tetrahedron(const std::array<Point_3, 5>& p) {
    const CGAL::Orientation side = CGAL::orientation(p[0], p[1], p[2], p[3]);
    if (side != CGAL::COPLANAR) { // four orientations: quicker than Tetrahedron_3::bounded_side
      const CGAL::Orientation outside = CGAL::opposite(side);
      return CGAL::orientation(p[4], p[1], p[2], p[3]) != outside &&
             CGAL::orientation(p[0], p[4], p[2], p[3]) != outside &&
             CGAL::orientation(p[0], p[1], p[4], p[3]) != outside &&
             CGAL::orientation(p[0], p[1], p[2], p[4]) != outside;
    }
    bool in_line = true;
    for (int i = 0; i < 4; ++i) {
      const Point_3 &a = p[(i + 1) % 4], &b = p[(i + 2) % 4], &c = p[(i + 3) % 4];
      if (CGAL::collinear(a, b, c))
        continue;
      in_line = false;
      if (Triangle_3(a, b, c).has_on(p[4]))
        return true;
    }
    if (!in_line)
      return false;
    const auto [low, high] = std::minmax({p[0], p[1], p[2], p[3]});
    return low == high ? p[4] == low : Segment_3(low, high).has_on(p[4]);
  }
};

} // namespace haptic_sculpt::test
