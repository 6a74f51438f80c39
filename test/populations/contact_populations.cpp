// SPDX-License-Identifier: GPL-3.0-or-later
#include "populations/draw_populations.h"

#include <cmath>

namespace haptic_sculpt::test {

namespace {

void move_by_one_ulp_or_not(Portable_random& random, Five_points& points) {
  const int coordinate = random.integer(0, 14);
  double& c = points[coordinate / 3][coordinate % 3];
  const int ulps = random.integer(-1, 1);
  if (ulps != 0)
    c = std::nextafter(c, ulps * INFINITY);
}

} // namespace

Five_points contact_ulp(Sweep_kind kind, Portable_random& random, int size) {
  Five_points points = random_points(random, random.one_in(2));
  const int swept = swept_points(kind);
  const bool triangle_stands = kind == Sweep_kind::vertex_face;
  const int others = triangle_stands ? swept : 5 - swept;
  const int other_size = size == 3 ? 1 : random.integer(1, others); // a segment through a face would be no touch
  const std::vector<int> moving = random_subset(random, 0, swept, triangle_stands ? other_size : size);
  const std::vector<int> standing = random_subset(random, swept, 5, triangle_stands ? size : other_size);
  bring_into_contact(random, kind, points, moving, standing);
  move_by_one_ulp_or_not(random, points);
  return points;
}

Five_points start_or_end_in_contact(Sweep_kind kind, Portable_random& random) {
  Five_points points = random_points(random, random.integer(1, 3) != 1);
  std::vector<int> feature{random.integer(0, 1)}; // S or T, with the far end of the edge or face
  for (int i = 2; i < swept_points(kind); ++i)
    feature.push_back(i);
  bring_into_contact(random, kind, points, feature, random_subset(random, swept_points(kind), 5));
  if (random.one_in(4))
    move_by_one_ulp_or_not(random, points);
  return points;
}

Five_points tiny_motion(Sweep_kind kind, Portable_random& random) {
  const bool exact = random.one_in(2);
  Five_points points = random_points(random, exact);
  points[1] = points[0] + (exact ? lattice_point(random, 2, 0x1p-30) : random_point(random, 1e-9));
  if (random.integer(1, 4) != 1)
    bring_into_contact(random, kind, points);
  return points;
}

Five_points zero_motion(Sweep_kind kind, Portable_random& random) {
  Five_points points = random_points(random, random.integer(1, 3) != 1);
  points[1] = points[0];
  if (random.integer(1, 4) != 1)
    bring_into_contact(random, kind, points);
  if (random.one_in(4)) {
    move_by_one_ulp_or_not(random, points);
    points[1] = points[0];
  }
  return points;
}

} // namespace haptic_sculpt::test
