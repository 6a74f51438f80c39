// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oracle/Sweep_kind.h"
#include "populations/Portable_random.h"

#include <array>
#include <vector>

namespace haptic_sculpt::test {

using Point = std::array<double, 3>;

inline Point operator+(const Point& p, const Point& q) { return {p[0] + q[0], p[1] + q[1], p[2] + q[2]}; }
inline Point operator-(const Point& p, const Point& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
inline Point operator*(double s, const Point& p) { return {s * p[0], s * p[1], s * p[2]}; }

/// The five points of a query while it is being built. Points of a *lattice* have coordinates in 2^-20 Z, at most 2:
/// sums, differences and sixteenths of them are exact, so that what is built to touch touches.
struct Five_points {
  std::array<Point, 5> point;
  Point& operator[](int i) { return point[i]; }
  const Point& operator[](int i) const { return point[i]; }
};

inline Point random_point(Portable_random& random, double half_width = 1) {
  Point p;
  for (double& c : p)
    c = random.real(-half_width, half_width);
  return p;
}

inline Point lattice_point(Portable_random& random, int steps = 1 << 20, double step = 0x1p-20) {
  Point p;
  for (double& c : p)
    c = random.integer(-steps, steps) * step;
  return p;
}

/// Five points in [-1, 1]^3: of the lattice (`exact`) or with all their bits random.
inline Five_points random_points(Portable_random& random, bool exact) {
  Five_points points;
  for (Point& p : points.point)
    p = exact ? lattice_point(random) : random_point(random);
  return points;
}

/// A random non-empty set of `size` (0: any number) out of the indices [first, last).
inline std::vector<int> random_subset(Portable_random& random, int first, int last, int size = 0) {
  std::vector<int> indices;
  for (int i = first; i < last; ++i)
    indices.push_back(i);
  for (int i = 0; i + 1 < last - first; ++i)
    std::swap(indices[i], indices[random.integer(i, last - first - 1)]);
  indices.resize(size != 0 ? size : random.integer(1, last - first));
  return indices;
}

/// A point of the relative interior of the hull of the given points, with weights in sixteenths.
inline Point combination(Portable_random& random, const Five_points& points, const std::vector<int>& indices) {
  std::vector<int> weight(indices.size(), 1);
  for (int left = 16 - static_cast<int>(indices.size()); left > 0; --left)
    ++weight[random.integer(0, static_cast<int>(indices.size()) - 1)];
  Point sum{0, 0, 0};
  for (std::size_t k = 0; k < indices.size(); ++k)
    sum = sum + (weight[k] / 16.) * points[indices[k]];
  return sum;
}

/// Moves the standing hull so that a point of the hull of `swept` falls on a point of the hull of `standing`: exactly
/// for points of the lattice, up to rounding for others.
inline void bring_into_contact(Portable_random& random, Sweep_kind kind, Five_points& points,
                               const std::vector<int>& swept, const std::vector<int>& standing) {
  const Point target = combination(random, points, swept);
  const Point shift = target - combination(random, points, standing);
  for (int i = swept_points(kind); i < 5; ++i)
    points[i] = points[i] + shift;
}

/// The same between random faces of the two hulls, of any dimension.
inline void bring_into_contact(Portable_random& random, Sweep_kind kind, Five_points& points) {
  const std::vector<int> swept = random_subset(random, 0, swept_points(kind));
  const std::vector<int> standing = random_subset(random, swept_points(kind), 5);
  bring_into_contact(random, kind, points, swept, standing);
}

/// The same between the two hulls as a whole: a hit of the common sort.
inline void aim(Portable_random& random, Sweep_kind kind, Five_points& points) {
  const int size = swept_points(kind);
  const std::vector<int> swept = random_subset(random, 0, size, size);
  const std::vector<int> standing = random_subset(random, size, 5, 5 - size);
  bring_into_contact(random, kind, points, swept, standing);
}

} // namespace haptic_sculpt::test
