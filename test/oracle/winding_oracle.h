// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Where a point lies and which way a closed surface is turned, over integers, by brute force. Uses nothing of the
/// library and nothing of CGAL.

#include <oracle/exact_triangles.h>

#include <optional>
#include <random>

namespace oracle {

/// How often a closed surface winds around a point that does not lie on it: signed crossings of a ray in a random
/// direction, drawn again until it meets no edge and no corner.
inline int winding_number(const std::vector<Point<mpz_class>>& points, const std::vector<Corner_indices>& faces, int p,
                          std::mt19937& random) {
  const auto from_p = [&](int i) {
    return Point<mpz_class>{points[i][0] - points[p][0], points[i][1] - points[p][1], points[i][2] - points[p][2]};
  };
  const auto determinant = [](const Point<mpz_class>& a, const Point<mpz_class>& b, const Point<mpz_class>& c) {
    return sgn(mpz_class(a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                         a[2] * (b[0] * c[1] - b[1] * c[0])));
  };
  const auto along = [&](const Point<mpz_class>& ray) -> std::optional<int> {
    int crossings = 0;
    for (const auto& f : faces) {
      const auto a = from_p(f[0]), b = from_p(f[1]), c = from_p(f[2]);
      const int u = determinant(ray, a, b), v = determinant(ray, b, c), w = determinant(ray, c, a);
      const bool some_positive = u > 0 || v > 0 || w > 0, some_negative = u < 0 || v < 0 || w < 0;
      if (some_positive && some_negative)
        continue;
      if (u == 0 || v == 0 || w == 0)
        return std::nullopt;
      const int height = determinant(a, b, c);
      if (height == 0)
        throw std::logic_error("winding_number: the point lies on the surface");
      if (height == u) // ahead, not behind
        crossings += u;
    }
    return crossings;
  };
  for (;;) {
    const auto draw = [&] { return mpz_class(static_cast<long>(random() % 4000001) - 2000000); };
    const Point<mpz_class> ray{draw(), draw(), draw()};
    if (const auto crossings = along(ray))
      return *crossings;
  }
}

/// The sign of the volume that a closed surface encloses, positive if its normals point out of it.
inline int volume_sign(const std::vector<Point<mpz_class>>& points, const std::vector<Corner_indices>& faces) {
  mpz_class volume = 0;
  const Point<mpz_class> o{0, 0, 0};
  for (const auto& f : faces)
    volume += determinant_3(o, points[f[0]], points[f[1]], points[f[2]]);
  return sgn(volume);
}

} // namespace oracle
