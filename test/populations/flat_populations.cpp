// SPDX-License-Identifier: GPL-3.0-or-later
#include "populations/draw_populations.h"

#include <cmath>

namespace haptic_sculpt::test {

Five_points coplanar_axis(Sweep_kind kind, Portable_random& random) {
  Five_points points = random.one_in(2) ? random_points(random, true) : integer_grid(kind, random);
  const int axis = random.integer(0, 2);
  const double height = random.one_in(4) ? 0 : random.real(-1, 1);
  for (Point& p : points.point)
    p[axis] = 0;
  if (random.integer(1, 3) != 1)
    bring_into_contact(random, kind, points);
  for (Point& p : points.point)
    p[axis] = height;
  if (random.one_in(8)) {
    double& c = points[random.integer(0, 4)][axis];
    c = std::nextafter(c, 2);
  }
  return points;
}

Five_points coplanar_oblique(Sweep_kind kind, Portable_random& random) {
  const bool exact = random.integer(1, 4) != 1;
  const Point origin = lattice_point(random), e = lattice_point(random, 1 << 10, 0x1p-10),
              f = lattice_point(random, 1 << 10, 0x1p-10);
  Five_points points;
  for (Point& p : points.point) {
    const double i = exact ? random.integer(-8, 8) / 8. : random.real(-1, 1);
    const double j = exact ? random.integer(-8, 8) / 8. : random.real(-1, 1);
    p = origin + (i * e + j * f);
  }
  if (random.integer(1, 3) != 1)
    bring_into_contact(random, kind, points);
  return points;
}

Five_points slivers(Sweep_kind kind, Portable_random& random) {
  const double thickness = 1e-12;
  Five_points points = random_points(random, random.one_in(2));
  const auto towards = [&](int i, const std::vector<int>& others) { // onto their hull, but for 1e-12
    const Point target = combination(random, points, others);
    points[i] = target + random_point(random, thickness);
  };
  switch (kind) {
  case Sweep_kind::vertex_face:
    towards(4, {2, 3});
    break;
  case Sweep_kind::edge_edge: {
    const int thin = random.integer(0, 2);
    towards(thin, {(thin + 1) % 3, (thin + 2) % 3});
    break;
  }
  case Sweep_kind::face_vertex: {
    const int thin = random.integer(0, 3);
    towards(thin, {(thin + 1) % 4, (thin + 2) % 4, (thin + 3) % 4});
    if (random.one_in(2)) // not only flat but a needle
      towards((thin + 1) % 4, {(thin + 2) % 4, (thin + 3) % 4});
  }
  }
  if (random.one_in(2))
    bring_into_contact(random, kind, points);
  else
    aim(random, kind, points);
  return points;
}

Five_points along_moved_edge(Sweep_kind kind, Portable_random& random) {
  Five_points points = random_points(random, random.integer(1, 3) != 1);
  const Point start = points[0];
  if (kind == Sweep_kind::vertex_face) { // no edge moves: go along one of the triangle
    const Point direction = points[3] - points[2];
    points[0] = points[2] + (random.integer(-16, 32) / 16.) * direction;
    points[1] = points[2] + (random.integer(-16, 32) / 16.) * direction;
    if (random.one_in(3)) {
      const Point shift = random.integer(-4, 4) / 16. * (points[4] - points[2]);
      points[0] = points[0] + shift;
      points[1] = points[1] + shift;
    }
    return points;
  }
  // the far end, or for a moving face now and then a point between its two far corners
  const Point far =
      kind == Sweep_kind::face_vertex && random.one_in(3) ? combination(random, points, {2, 3}) : points[2];
  points[1] = start + (random.integer(-16, 32) / 16.) * (far - start);
  if (random.integer(1, 4) != 1)
    bring_into_contact(random, kind, points);
  return points;
}

Five_points collinear_sweep(Sweep_kind kind, Portable_random& random) {
  Five_points points = random_points(random, random.integer(1, 3) != 1);
  const Point origin = points[0];
  const Point direction = 0.25 * points[1];
  const int last = kind == Sweep_kind::face_vertex && random.one_in(2) ? 4 : 3; // S T V, S T A, S T G or S T G I
  for (int i = 0; i < last; ++i)
    points[i] = origin + random.integer(-3, 3) * direction;
  if (random.integer(1, 4) != 1)
    bring_into_contact(random, kind, points);
  return points;
}

} // namespace haptic_sculpt::test
