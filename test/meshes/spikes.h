// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Closed valid meshes with parts that are thin and long.

#include "meshes/generated_meshes.h"

#include <algorithm>

namespace meshes {

/// A ball of radius 1 with a cone at each of the twelve vertices of an icosahedron, of this radius where it begins and
/// of this height: n is that of icosphere().
inline Triangle_list ball_with_cones(int n, double base, double height) {
  const Triangle_list tips = icosphere(0);
  return icosphere(n).transform([&](const Point_3& p) {
    double r = 1;
    for (const Point_3& tip : tips.points)
      r += height * std::max(0.0, 1 - std::sqrt(CGAL::squared_distance(p, tip)) / base);
    return Point_3(p.x() * r, p.y() * r, p.z() * r);
  });
}

/// A gear of about radius 1 with a bore of radius 0.3, thin and flat. Its flat sides are strips of triangles from the
/// bore to the teeth, all needles. \param steps a tooth, of the outline
inline Triangle_list gear(std::size_t teeth, std::size_t steps, double thickness = 0.2) {
  Triangle_list list;
  const std::size_t n = teeth * steps;
  for (std::size_t i = 0; i < n; ++i) {
    const double u = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(n),
                 in_tooth = static_cast<double>(i % steps) / static_cast<double>(steps),
                 rise = std::min(1.0, std::max(0.0, 4 - 10 * std::abs(in_tooth - 0.5))), r = 1 + 0.1 * rise;
    for (const double side : {-0.5, 0.5}) {
      list.add_point(r * std::cos(u), r * std::sin(u), side * thickness);
      list.add_point(0.3 * std::cos(u), 0.3 * std::sin(u), side * thickness);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t a = 4 * i, b = 4 * ((i + 1) % n); // low outer, low inner, high outer, high inner
    list.add_quadrangle(a, b, b + 2, a + 2);
    list.add_quadrangle(a + 2, b + 2, b + 3, a + 3);
    list.add_quadrangle(a + 3, b + 3, b + 1, a + 1);
    list.add_quadrangle(a + 1, b + 1, b, a);
  }
  return list;
}

} // namespace meshes
