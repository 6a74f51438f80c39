// SPDX-License-Identifier: GPL-3.0-or-later
#include "populations/draw_populations.h"

#include <cmath>

namespace haptic_sculpt::test {

namespace {

/// A query of moderate coordinates, of any sort.
Five_points any_regular(Sweep_kind kind, Portable_random& random) {
  switch (random.integer(0, 7)) {
  case 0: return random_box(kind, random);
  case 1: return sculpt_scale(kind, random);
  case 2: return integer_grid(kind, random);
  case 3: return contact_ulp(kind, random, random.integer(1, 3));
  case 4: return start_or_end_in_contact(kind, random);
  case 5: return coplanar_oblique(kind, random);
  case 6: return collinear_sweep(kind, random);
  default: {
    Five_points points = random_points(random, true);
    bring_into_contact(random, kind, points);
    return points;
  }
  }
}

} // namespace

Five_points scaled(Sweep_kind kind, Portable_random& random, double factor) {
  Five_points points = any_regular(kind, random);
  const double multiplier = random.one_in(2) ? factor : std::ldexp(1., std::ilogb(factor));
  for (Point& p : points.point)
    p = multiplier * p;
  return points;
}

Five_points offset(Sweep_kind kind, Portable_random& random, double offset) {
  Five_points points = any_regular(kind, random);
  // On a lattice the sum is exact: 2^30 and 2^-20 fit one significand. Else it rounds, and touches become near misses.
  const double distance = random.one_in(2) ? std::floor(offset) : offset * random.real(0.5, 1);
  const Point shift{random.sign() * distance, random.sign() * distance, random.sign() * distance};
  for (Point& p : points.point)
    p = p + shift;
  return points;
}

Five_points mixed_exponents(Sweep_kind kind, Portable_random& random) {
  constexpr std::array<int, 4> ranges{30, 100, 300, 996}; // 2^996 is 6.7e299
  const int range = ranges[random.integer(0, 3)];
  Five_points points;
  if (random.one_in(2)) {
    // Another power of two for each axis is an exact affine map: verdict and time stay.
    points = any_regular(kind, random);
    for (int axis = 0; axis < 3; ++axis) {
      const int exponent = random.integer(-range, range);
      for (Point& p : points.point)
        p[axis] = std::ldexp(p[axis], exponent);
    }
    return points;
  }
  for (int i = 0; i < 5; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      double& c = points[i][axis];
      const int exponent = random.integer(-range, range);
      const double sign = random.sign();
      c = std::ldexp(sign * random.real(1, 2), exponent);
      if (random.one_in(8))
        c = 0;
      else if (i > 0 && random.one_in(4))
        c = points[random.integer(0, i - 1)][axis];
    }
  const int touch = random.integer(0, 3);
  if (touch == 0)
    bring_into_contact(random, kind, points);
  else if (touch == 1) {
    const int standing = random.integer(swept_points(kind), 4);
    points[standing] = points[random.integer(0, swept_points(kind) - 1)];
  }
  return points;
}

Five_points subnormal(Sweep_kind kind, Portable_random& random) {
  Five_points points;
  const int steps = random.one_in(2) ? 3 : 1 << 20;
  for (Point& p : points.point)
    for (double& c : p)
      c = 16 * random.integer(-steps, steps); // sixteenths of the differences are integers
  if (random.integer(1, 3) != 1)
    bring_into_contact(random, kind, points);
  for (Point& p : points.point)
    p = 0x1p-1074 * p;
  return points;
}

} // namespace haptic_sculpt::test
