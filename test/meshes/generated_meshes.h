// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Closed valid meshes, generated. The same call gives the same doubles on every machine only if the compiler does not
/// fuse multiplications and additions (`-ffp-contract=off` with `-march=native`) and its libm rounds sin and cos alike.
/// Normals point out of the solid unless a name says otherwise.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace meshes {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_3 = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point_3>;

/// Points and triangles before they become a mesh.
struct Triangle_list {
  std::vector<Point_3> points;
  std::vector<std::array<std::size_t, 3>> faces;

  std::size_t add_point(double x, double y, double z) {
    points.emplace_back(x, y, z);
    return points.size() - 1;
  }
  void add_face(std::size_t a, std::size_t b, std::size_t c) { faces.push_back({a, b, c}); }
  /// Splits the quadrangle a b c d along a c.
  void add_quadrangle(std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    add_face(a, b, c);
    add_face(a, c, d);
  }
  /// Appends another list as further components.
  Triangle_list& operator+=(const Triangle_list& other) {
    const std::size_t offset = points.size();
    points.insert(points.end(), other.points.begin(), other.points.end());
    for (const auto& f : other.faces)
      add_face(f[0] + offset, f[1] + offset, f[2] + offset);
    return *this;
  }
  Triangle_list& turn_inside_out() {
    for (auto& f : faces)
      std::swap(f[1], f[2]);
    return *this;
  }
  Triangle_list& transform(const std::function<Point_3(const Point_3&)>& function) {
    for (Point_3& p : points)
      p = function(p);
    return *this;
  }
  Triangle_list& scale_and_move(double factor, double x, double y, double z) {
    return transform(
        [=](const Point_3& p) { return Point_3(p.x() * factor + x, p.y() * factor + y, p.z() * factor + z); });
  }
};

/// Vertices and faces keep their order. \throw std::logic_error if a face cannot be added
template <class Any_mesh = Mesh>
Any_mesh to_mesh(const Triangle_list& list) {
  using Vertex = typename Any_mesh::Vertex_index;
  Any_mesh mesh;
  mesh.reserve(list.points.size(), list.faces.size() * 3 / 2, list.faces.size());
  for (const Point_3& p : list.points)
    mesh.add_vertex(typename Any_mesh::Point(p.x(), p.y(), p.z()));
  for (const auto& f : list.faces)
    if (mesh.add_face(Vertex(f[0]), Vertex(f[1]), Vertex(f[2])) == Any_mesh::null_face())
      throw std::logic_error("generated mesh: face cannot be added");
  return mesh;
}

inline Triangle_list tetrahedron(double size = 1) {
  Triangle_list list;
  list.points = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
  list.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return list;
}

/// A cube of edge `size` at the origin whose six sides are n x n coplanar cells of two triangles: flat regions, right
/// angles and parallel edges everywhere.
inline Triangle_list box(std::size_t n = 1, double size = 1) {
  Triangle_list list;
  std::map<std::array<std::size_t, 3>, std::size_t> index;
  const auto vertex = [&](const std::array<std::size_t, 3>& cell) {
    const auto [place, is_new] = index.emplace(cell, list.points.size());
    if (is_new)
      list.add_point(size * cell[0] / n, size * cell[1] / n, size * cell[2] / n);
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const std::size_t side : {std::size_t(0), n})
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
          const auto at = [&](std::size_t u, std::size_t v) {
            std::array<std::size_t, 3> cell;
            cell[axis] = side;
            cell[(axis + 1) % 3] = u;
            cell[(axis + 2) % 3] = v;
            return vertex(cell);
          };
          if (side == 0)
            list.add_quadrangle(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
          else
            list.add_quadrangle(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
  return list;
}

inline Triangle_list cube(double size = 1) {
  return box(1, size);
}

/// An icosahedron split n times, 20 * 4^n triangles, every vertex put on the sphere of radius 1.
inline Triangle_list icosphere(int n) {
  const double t = (1 + std::sqrt(5.0)) / 2;
  Triangle_list list;
  list.points = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                 {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
  list.faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < n; ++level) {
    Triangle_list finer;
    finer.points = list.points;
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
    const auto middle = [&](std::size_t a, std::size_t b) {
      const auto [place, is_new] = middles.emplace(std::minmax(a, b), finer.points.size());
      if (is_new)
        finer.points.push_back(CGAL::midpoint(list.points[a], list.points[b]));
      return place->second;
    };
    for (const auto& f : list.faces) {
      const std::size_t ab = middle(f[0], f[1]), bc = middle(f[1], f[2]), ca = middle(f[2], f[0]);
      finer.add_face(f[0], ab, ca);
      finer.add_face(f[1], bc, ab);
      finer.add_face(f[2], ca, bc);
      finer.add_face(ab, bc, ca);
    }
    list = std::move(finer);
  }
  return list.transform([](const Point_3& p) {
    const double r = std::sqrt(p.x() * p.x() + p.y() * p.y() + p.z() * p.z());
    return Point_3(p.x() / r, p.y() / r, p.z() / r);
  });
}

/// A sphere with smooth hills of height up to `height`, and radial noise of amplitude `noise` drawn from `seed`:
/// rough terrain that never folds over, as every point moves along its radius.
inline Triangle_list bumpy_sphere(int n, double height = 0.2, double noise = 0, std::uint32_t seed = 1) {
  std::mt19937 random(seed);
  std::vector<std::array<double, 5>> hills(12);
  const auto uniform = [&] { return random() / 2147483648.0 - 1; }; // exact, unlike std::uniform_real_distribution
  for (auto& hill : hills)
    for (double& x : hill)
      x = uniform();
  return icosphere(n).transform([&](const Point_3& p) {
    double r = 1;
    for (const auto& [a, b, c, phase, weight] : hills)
      r += height / 12 * weight * std::sin(8 * (a * p.x() + b * p.y() + c * p.z()) + 3 * phase);
    r += noise * uniform();
    return Point_3(p.x() * r, p.y() * r, p.z() * r);
  });
}

/// A torus of radii 1 and `tube` about the z axis with m x n quadrangles, 2 m n triangles. \pre m, n >= 3
inline Triangle_list torus(std::size_t m, std::size_t n, double tube = 0.4) {
  Triangle_list list;
  list.points.reserve(m * n);
  list.faces.reserve(2 * m * n);
  constexpr double turn = 6.283185307179586;
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const double u = turn * i / m, v = turn * j / n, r = 1 + tube * std::cos(v);
      list.add_point(r * std::cos(u), r * std::sin(u), tube * std::sin(v));
    }
  const auto at = [&](std::size_t i, std::size_t j) { return (i % m) * n + j % n; };
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < n; ++j)
      list.add_quadrangle(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return list;
}

/// Two apices over and under a ring of `valence` vertices: the apices (the last two vertices) have that valence.
inline Triangle_list bipyramid(std::size_t valence, double height = 1) {
  Triangle_list list;
  for (std::size_t i = 0; i < valence; ++i) {
    const double u = 6.283185307179586 * i / valence;
    list.add_point(std::cos(u), std::sin(u), 0);
  }
  const std::size_t top = list.add_point(0, 0, height), bottom = list.add_point(0, 0, -height);
  for (std::size_t i = 0; i < valence; ++i) {
    const std::size_t j = (i + 1) % valence;
    list.add_face(i, j, top);
    list.add_face(j, i, bottom);
  }
  return list;
}

/// `n` icospheres of radius 0.4 along the x axis, one apart: several objects in one mesh.
inline Triangle_list row_of_spheres(std::size_t n, int level = 1) {
  Triangle_list list;
  for (std::size_t i = 0; i < n; ++i) {
    Triangle_list sphere = icosphere(level);
    list += sphere.scale_and_move(0.4, static_cast<double>(i), 0, 0);
  }
  return list;
}

/// A thick shell around a loose ball: a sphere of radius 2, in it the wall of a cavity of radius 1.5 (normals inwards),
/// in that a ball of radius 1.
inline Triangle_list ball_in_a_cavity(int level = 2) {
  Triangle_list list = icosphere(level), wall = icosphere(level), ball = icosphere(level);
  list.scale_and_move(2, 0, 0, 0);
  list += wall.scale_and_move(1.5, 0, 0, 0).turn_inside_out();
  list += ball;
  return list;
}

/// A closed tube of square section bent to a C whose two plane end caps, at x = 0 and x = gap exactly, face each other.
/// \param n cells along the bend \pre n >= 5, gap < sin(2 pi / n)
inline Triangle_list c_tube(double gap, std::size_t n = 32) {
  Triangle_list list;
  // The bend runs from the cap at x = 0 through half planes about the z axis to the cap at x = gap.
  constexpr double turn = 6.283185307179586;
  for (std::size_t i = 0; i <= n; ++i) {
    const double u = turn * i / n;
    for (const auto& [r, z] : {std::pair(1.0, -0.2), std::pair(1.4, -0.2), std::pair(1.4, 0.2), std::pair(1.0, 0.2)}) {
      if (i == 0)
        list.add_point(0, r, z);
      else if (i == n)
        list.add_point(gap, r, z);
      else
        list.add_point(-r * std::sin(u), r * std::cos(u), z);
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 4; ++k)
      list.add_quadrangle(4 * i + k, 4 * i + (k + 1) % 4, 4 * (i + 1) + (k + 1) % 4, 4 * (i + 1) + k);
  list.add_quadrangle(3, 2, 1, 0);
  list.add_quadrangle(4 * n, 4 * n + 1, 4 * n + 2, 4 * n + 3);
  return list.turn_inside_out();
}

/// A prism cut into `n` layers of thickness `thickness` (powers of two keep it exact): its side faces are slivers.
inline Triangle_list sliver_stack(std::size_t n, double thickness) {
  Triangle_list list;
  for (std::size_t i = 0; i <= n; ++i) {
    list.add_point(0, 0, i * thickness);
    list.add_point(1, 0, i * thickness);
    list.add_point(0, 1, i * thickness);
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      list.add_quadrangle(3 * i + k, 3 * i + (k + 1) % 3, 3 * (i + 1) + (k + 1) % 3, 3 * (i + 1) + k);
  list.add_face(0, 2, 1);
  list.add_face(3 * n, 3 * n + 1, 3 * n + 2);
  return list;
}

/// Two tetrahedra whose apices face each other `gap` apart on the x axis: pinched but for the gap.
inline Triangle_list nearly_pinched(double gap) {
  Triangle_list list = tetrahedron(), other = tetrahedron();
  list.points = {{-1, -1, -1}, {-1, 1, -1}, {-1, 0, 1}, {0, 0, 0}};
  other.points = {{1, -1, -1}, {1, 1, -1}, {1, 0, 1}, {gap, 0, 0}};
  other.turn_inside_out();
  list += other;
  return list;
}

} // namespace meshes
