// SPDX-License-Identifier: GPL-3.0-or-later
#include "populations/sweep_populations.h"

#include "oracle/integer_coordinates.h"
#include "populations/draw_populations.h"

#include <algorithm>
#include <cmath>
#include <gmpxx.h>

namespace haptic_sculpt::test {

namespace {

/// A hit for certain, a hit or a miss by less than `size`, or whatever comes: otherwise most queries would be far
/// misses.
void aim_or_miss(Sweep_kind kind, Portable_random& random, Five_points& points, double size) {
  const int choice = random.integer(0, 3);
  if (choice >= 1)
    aim(random, kind, points);
  if (choice >= 2) {
    const Point shift = random_point(random, size);
    for (int i = swept_points(kind); i < 5; ++i)
      points[i] = points[i] + shift;
  }
}

} // namespace

Five_points random_box(Sweep_kind kind, Portable_random& random) {
  Five_points points = random_points(random, false);
  aim_or_miss(kind, random, points, 0.2);
  return points;
}

Five_points sculpt_scale(Sweep_kind kind, Portable_random& random) {
  Five_points points;
  const Point place = random_point(random);
  for (Point& p : points.point)
    p = place + random_point(random, 0.005);
  points[1] = points[0] + random_point(random, 0.001);
  aim_or_miss(kind, random, points, 0.0005);
  return points;
}

Five_points integer_grid(Sweep_kind, Portable_random& random) {
  Five_points points;
  const int width = random.integer(1, 3);
  for (Point& p : points.point)
    p = lattice_point(random, width, 1);
  return points;
}

Five_points tenths(Sweep_kind kind, Portable_random& random) {
  Five_points points;
  const int width = random.integer(1, 5);
  const bool divide = random.one_in(2); // 3 / 10. and 3 * 0.1 are two numbers
  for (Point& p : points.point)
    for (double& c : p) {
      const int k = random.integer(-width, width);
      c = divide ? k / 10. : k * 0.1;
    }
  if (random.one_in(3))
    bring_into_contact(random, kind, points);
  return points;
}

Five_points coincident_points(Sweep_kind kind, Portable_random& random) {
  Five_points points = random.one_in(2) ? integer_grid(kind, random) : random_points(random, true);
  for (int copies = random.integer(1, 3); copies > 0; --copies) {
    const int copied = random.integer(0, 4);
    points[random.integer(0, 4)] = points[copied];
  }
  if (random.one_in(2))
    bring_into_contact(random, kind, points);
  return points;
}

bool standing_features_are_simplices(Sweep_kind kind, const Sweep_coordinates& x) {
  const auto differ = [&x](int i, int j) {
    return x[3 * i] != x[3 * j] || x[3 * i + 1] != x[3 * j + 1] || x[3 * i + 2] != x[3 * j + 2];
  };
  if (kind == Sweep_kind::face_vertex)
    return differ(2, 3);
  if (kind == Sweep_kind::edge_edge)
    return differ(3, 4);
  thread_local std::array<mpz_class, 9> coordinate; // one scale for each axis: it keeps collinear what is
  for (int axis = 0; axis < 3; ++axis)
    scale_to_integers(
        {x[6 + axis], x[9 + axis], x[12 + axis]},
        {coordinate[axis].get_mpz_t(), coordinate[3 + axis].get_mpz_t(), coordinate[6 + axis].get_mpz_t()});
  for (int i = 8; i >= 3; --i)
    coordinate[i] -= coordinate[i % 3]; // B - A and C - A
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3;
    if (coordinate[3 + axis] * coordinate[6 + next] != coordinate[3 + next] * coordinate[6 + axis])
      return true;
  }
  return false;
}

Sweep_query Sweep_population::operator()(Sweep_kind kind, std::mt19937_64& engine) const {
  Sweep_query query{kind, draw(kind, engine)};
  const auto is_finite = [](double c) { return std::isfinite(c); };
  while (!std::all_of(query.x.begin(), query.x.end(), is_finite) || !standing_features_are_simplices(kind, query.x))
    query.x = draw(kind, engine);
  return query;
}

Sweep_query Sweep_population::operator()(std::mt19937_64& engine) const {
  return operator()(sweep_kinds[Portable_random(engine).integer(0, 2)], engine);
}

namespace {

template <class Draw> Sweep_population population(const char* name, bool degenerate, Draw draw) {
  return {name, degenerate, [draw](Sweep_kind kind, std::mt19937_64& engine) {
            Portable_random random(engine);
            const Five_points points = draw(kind, random);
            Sweep_coordinates x;
            for (int i = 0; i < 15; ++i)
              x[i] = points[i / 3][i % 3];
            return x;
          }};
}

Sweep_population contact_population(const char* name, int size) {
  return population(name, true, [size](Sweep_kind kind, Portable_random& random) {
    return contact_ulp(kind, random, size);
  });
}

Sweep_population scaled_population(const char* name, double factor) {
  return population(name, true, [factor](Sweep_kind kind, Portable_random& random) {
    return scaled(kind, random, factor);
  });
}

Sweep_population offset_population(const char* name, double distance) {
  return population(name, true, [distance](Sweep_kind kind, Portable_random& random) {
    return offset(kind, random, distance);
  });
}

} // namespace

const std::vector<Sweep_population>& sweep_populations() {
  static const std::vector<Sweep_population> populations{
    population("random_box", false, random_box),
    population("sculpt_scale", false, sculpt_scale),
    population("integer_grid", true, integer_grid),
    population("tenths", true, tenths),
    contact_population("contact_face_ulp", 3),
    contact_population("contact_edge_ulp", 2),
    contact_population("contact_vertex_ulp", 1),
    population("start_or_end_in_contact", true, start_or_end_in_contact),
    population("coplanar_axis", true, coplanar_axis),
    population("coplanar_oblique", true, coplanar_oblique),
    population("slivers_1e-12", true, slivers),
    population("tiny_motion_1e-9", true, tiny_motion),
    population("zero_motion", true, zero_motion),
    population("along_moved_edge", true, along_moved_edge),
    population("collinear_sweep", true, collinear_sweep),
    population("coincident_points", true, coincident_points),
    scaled_population("scaled_1e+100", 1e100),
    scaled_population("scaled_1e-100", 1e-100),
    scaled_population("scaled_1e+300", 1e300),
    scaled_population("scaled_1e-300", 1e-300),
    offset_population("offset_1e6", 1e6),
    offset_population("offset_1e9", 1e9),
    population("mixed_exponents", true, mixed_exponents),
    population("subnormal", true, subnormal),
    scaled_population("scaled_to_overflow", 2e307), // differences of these coordinates are infinite
  };
  return populations;
}

} // namespace haptic_sculpt::test
