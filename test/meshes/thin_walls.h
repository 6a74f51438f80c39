// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Closed meshes with walls much thinner than their edges are long: what smoothing without a guard drives through
/// itself.

#include "meshes/generated_meshes.h"

namespace meshes {

/// From -1 to 1, the same on every machine.
inline double uniform(std::mt19937& random) {
  return random() / 2147483648.0 - 1;
}

/// An icosphere whose vertices have been pushed about on the sphere by up to `jitter` each way.
inline Triangle_list jittered_sphere(int n, double jitter, std::mt19937& random) {
  return icosphere(n).transform([&](const Point_3& p) {
    const double x = p.x() + jitter * uniform(random), y = p.y() + jitter * uniform(random),
                 z = p.z() + jitter * uniform(random);
    const double r = std::sqrt(x * x + y * y + z * z);
    return Point_3(x / r, y / r, z / r);
  });
}

/// A hollow ball: a sphere of radius 1 and, `wall` below it, another one, each with its own uneven triangles.
/// \pre the wall is thicker than the spheres' triangles are deep, about a sixth of the square of an edge
inline Triangle_list hollow_ball(int n = 3, double wall = 0.02, std::uint32_t seed = 1) {
  std::mt19937 random(seed);
  const double jitter = 0.2 / (1 << n);
  Triangle_list list = jittered_sphere(n, jitter, random), inner = jittered_sphere(n, jitter, random);
  inner.scale_and_move(1 - wall, 0, 0, 0).turn_inside_out();
  list += inner;
  return list;
}

/// A plate of n x n cells of edge 1, waved, of an even thickness measured along z, its upper and its lower side
/// triangulated differently. \pre jitter < 0.25; the thickness is more than the sides differ by
inline Triangle_list wavy_plate(std::size_t n = 16, double thickness = 0.1, double height = 0.5, double jitter = 0.2,
                                std::uint32_t seed = 1) {
  std::mt19937 random(seed);
  Triangle_list list;
  const double k = 6.283185307179586 / static_cast<double>(n);
  const auto at = [n](std::size_t side, std::size_t i, std::size_t j) {
    return side * (n + 1) * (n + 1) + i * (n + 1) + j;
  };
  for (const double z : {0.0, thickness})
    for (std::size_t i = 0; i <= n; ++i)
      for (std::size_t j = 0; j <= n; ++j) {
        const bool is_rim = i == 0 || j == 0 || i == n || j == n;
        const double x = static_cast<double>(i) + (is_rim ? 0 : jitter * uniform(random)),
                     y = static_cast<double>(j) + (is_rim ? 0 : jitter * uniform(random));
        list.add_point(x, y, height * std::sin(2 * k * x) * std::sin(k * y) + z);
      }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      list.add_quadrangle(at(0, i, j), at(0, i, j + 1), at(0, i + 1, j + 1), at(0, i + 1, j));
      list.add_quadrangle(at(1, i, j), at(1, i + 1, j), at(1, i + 1, j + 1), at(1, i, j + 1));
    }
  for (std::size_t k0 = 0; k0 < n; ++k0) {
    list.add_quadrangle(at(0, k0, 0), at(0, k0 + 1, 0), at(1, k0 + 1, 0), at(1, k0, 0));
    list.add_quadrangle(at(0, k0 + 1, n), at(0, k0, n), at(1, k0, n), at(1, k0 + 1, n));
    list.add_quadrangle(at(0, 0, k0 + 1), at(0, 0, k0), at(1, 0, k0), at(1, 0, k0 + 1));
    list.add_quadrangle(at(0, n, k0), at(0, n, k0 + 1), at(1, n, k0 + 1), at(1, n, k0));
  }
  return list;
}

/// A cube with a flat cavity close under one side. The cavity's cells are longer than they are high, so relaxation
/// drives its edges up, through the side.
inline Triangle_list hidden_cavity(double wall = 0.01) {
  Triangle_list list = box(8, 4), cavity = box(8);
  cavity.transform(
      [&](const Point_3& p) { return Point_3(1 + 1.5 * p.x(), 1 + 1.5 * p.y(), 4 - wall - 0.5 + 0.5 * p.z()); });
  cavity.turn_inside_out();
  list += cavity;
  return list;
}

/// A cube with n x n x n round holes in it, `wall` apart and as far from the cube's sides; each hole's triangles are
/// uneven.
inline Triangle_list swiss_cheese(std::size_t n = 2, double wall = 0.02, int level = 2, std::uint32_t seed = 1) {
  std::mt19937 random(seed);
  const double side = static_cast<double>(n) * (2 + wall) + wall;
  Triangle_list list = box(8 * n, side);
  for (std::size_t i = 0; i < n * n * n; ++i) {
    Triangle_list hole = jittered_sphere(level, 0.2 / (1 << level), random);
    const auto place = [&](std::size_t k) { return wall + 1 + static_cast<double>(k % n) * (2 + wall); };
    hole.scale_and_move(1, place(i), place(i / n), place(i / n / n)).turn_inside_out();
    list += hole;
  }
  return list;
}

/// Plates of a comb, 2^-35 apart.
inline Triangle_list comb(std::size_t teeth, std::size_t n) {
  Triangle_list list;
  for (std::size_t tooth = 0; tooth < teeth; ++tooth)
    list += box(n).transform([tooth](const Point_3& p) {
      return Point_3(p.x(), p.y(), 0.125 * p.z() + static_cast<double>(tooth) * (0.125 + 0x1p-35));
    });
  return list;
}

} // namespace meshes
