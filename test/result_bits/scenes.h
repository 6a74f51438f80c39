// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Digest.h"

#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace haptic_sculpt::result_bits {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_3 = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point_3>;
using Vertex_index = Mesh::Vertex_index;

/// Numbers that are the same everywhere, in every mode of rounding: multiples of a power of two.
class Draw {
public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  int below(std::size_t n) { return static_cast<int>(engine_() % n); }
  /// A multiple of 2^-bits in [-2, 2].
  double coordinate(int bits) { return std::ldexp(below((std::size_t{4} << bits) + 1), -bits) - 2; }
  Point_3 point(int bits) {
    const double x = coordinate(bits), y = coordinate(bits), z = coordinate(bits);
    return {x, y, z};
  }

private:
  std::mt19937_64 engine_;
};

/// An octahedron split `n` times, its vertices at multiples of 2^-16 near the sphere of that radius in 64ths.
/// In integers: no root is taken, so that none is rounded.
inline void add_ball(Mesh& mesh, int n, int radius, int x, std::uint64_t seed) {
  using Integers = std::array<long long, 3>;
  std::vector<Integers> points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (auto& p : points)
    for (auto& c : p)
      c *= 1 << 16;
  std::vector<std::array<std::size_t, 3>> faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                                   {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int i = 0; i < n; ++i) {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> middle;
    const auto between = [&](std::size_t a, std::size_t b) {
      const auto [place, is_new] = middle.emplace(std::minmax(a, b), points.size());
      if (is_new) {
        Integers m;
        long long square = 0;
        for (int k = 0; k < 3; ++k)
          m[k] = (points[a][k] + points[b][k]) / 2, square += m[k] * m[k];
        long long length = 1 << 16; // the root, by Newton's steps
        for (int step = 0; step < 40; ++step)
          length = (length + square / length) / 2;
        for (auto& c : m)
          c = c * (1 << 16) / length;
        points.push_back(m);
      }
      return place->second;
    };
    std::vector<std::array<std::size_t, 3>> finer;
    for (const auto& f : faces) {
      const std::size_t a = between(f[0], f[1]), b = between(f[1], f[2]), c = between(f[2], f[0]);
      finer.insert(finer.end(), {{f[0], a, c}, {a, f[1], b}, {c, b, f[2]}, {a, b, c}});
    }
    faces = std::move(finer);
  }
  Draw draw(seed);
  const auto first = static_cast<Mesh::size_type>(mesh.number_of_vertices());
  for (const auto& p : points) {
    const long long factor = radius + draw.below(4); // bumps
    double c[3];
    for (int k = 0; k < 3; ++k)
      c[k] = std::ldexp(static_cast<double>(p[k] * factor), -22);
    mesh.add_vertex({c[0] + x, c[1], c[2]});
  }
  for (const auto& f : faces)
    mesh.add_face(Vertex_index(first + f[0]), Vertex_index(first + f[1]), Vertex_index(first + f[2]));
}

inline Mesh bumpy_ball(int n) {
  Mesh mesh;
  add_ball(mesh, n, 64, 0, 11);
  return mesh;
}

/// Two that are near each other, 256 faces.
inline Mesh two_balls() {
  Mesh mesh;
  add_ball(mesh, 2, 58, -1, 12);
  add_ball(mesh, 2, 58, 1, 13);
  return mesh;
}

inline void add_mesh(Digest& digest, const Mesh& mesh) {
  for (const auto v : mesh.vertices())
    digest.add(internal::coordinates(mesh.point(v)));
  for (const auto f : mesh.faces())
    for (const auto v : internal::corners_of_face(mesh, f))
      digest.add(static_cast<int>(v));
}

} // namespace haptic_sculpt::result_bits
