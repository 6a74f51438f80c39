// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_KKT_RESIDUAL_H
#define HAPTIC_SCULPT_SCULPTING_KKT_RESIDUAL_H

#include <haptic_sculpt/sculpting/motion/vector_3.h>

#include <vector>

namespace haptic_sculpt {
namespace internal {

/// The sine between two unit normals below which their cross product is mostly rounding (2^-52 over it is the relative error), and
/// the same for the volume of three.
constexpr double least_sine = 0x1p-23, least_volume = 0x1p-33;

/// The distance from `pull` to the cone of all combinations of `-normals` with weights >= 0, over |pull|: 0 where the
/// contacts hold the vertex at a constrained nearest point to its target, 1 where none of them resists.
///
/// Normals more alike than `least_sine`, or three as good as coplanar, count as fewer: what they span beyond is rounding.
/// In space the nearest point of a cone is a combination of at most three generators, so subsets of up to three are
/// tried. Cost: cubic in the number of normals. Floating point.
inline double kkt_residual(const Vector& pull, const std::vector<Vector>& normals) {
  const double pull_length = length(pull);
  if (pull_length == 0)
    return 0;
  const Vector d = scaled(pull, 1 / pull_length);
  double best = 1;
  const auto keep = [&](const Vector& rest) { best = std::fmin(best, length(rest)); };
  const std::size_t n = normals.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector& a = normals[i];
    if (dot(a, d) >= 0)
      continue;
    keep(advanced(d, -dot(a, d), a));
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i)
        continue;
      const Vector& b = normals[j];
      const Vector axis = cross(a, b);
      const double square = dot(axis, axis);
      if (square < least_sine * least_sine)
        continue;
      // d = x a + y b + z axis; both weights of -a and -b have to be >= 0.
      const double ab = dot(a, b), da = dot(d, a), db = dot(d, b);
      const double x = std::fma(-ab, db, da) / square, y = std::fma(-ab, da, db) / square;
      if (x <= 0 && y <= 0)
        keep(scaled(axis, dot(d, axis) / square));
      for (std::size_t k = j + 1; k < n; ++k) {
        const Vector& c = normals[k];
        const double volume = dot(axis, c);
        if (k == i || std::abs(volume) < least_volume)
          continue;
        const double u = dot(cross(b, c), d) / volume, v = dot(cross(c, a), d) / volume, w = dot(axis, d) / volume;
        if (u <= 0 && v <= 0 && w <= 0)
          return 0;
      }
    }
  }
  return best;
}

} // namespace internal
} // namespace haptic_sculpt

#endif
