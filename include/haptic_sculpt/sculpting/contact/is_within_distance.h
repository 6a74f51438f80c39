// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_IS_WITHIN_DISTANCE_H
#define HAPTIC_SCULPT_SCULPTING_IS_WITHIN_DISTANCE_H

#include <haptic_sculpt/collision/arithmetic/exact_integers.h>

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

namespace haptic_sculpt {
namespace internal {

/// Whether p is at most `distance` from the closed triangle a, b, c; exact, over rationals. \pre a, b, c not collinear
inline bool is_within_distance(const Coordinates& p, const Coordinates& a, const Coordinates& b, const Coordinates& c,
                               double distance) {
  using Kernel = CGAL::Simple_cartesian<CGAL::Gmpq>;
  const auto point = [](const Coordinates& q) { return Kernel::Point_3(q[0], q[1], q[2]); };
  const CGAL::Gmpq limit(distance);
  return CGAL::compare(CGAL::squared_distance(point(p), Kernel::Triangle_3(point(a), point(b), point(c))),
                       CGAL::Gmpq(limit * limit)) != CGAL::LARGER;
}

} // namespace internal
} // namespace haptic_sculpt

#endif
