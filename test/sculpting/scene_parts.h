// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// What the scenes of slides are put together from: random numbers and motions, solids with corners, things to drag.

#include "sculpting/Random_scene.h"

#include <cmath>

namespace haptic_sculpt::test {

using Vector_3 = meshes::Kernel::Vector_3;

inline double uniform(Random& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

/// In the cube of half-edge `size`.
inline Vector_3 uniform_vector(Random& random, double size) {
  const double x = uniform(random, -size, size), y = uniform(random, -size, size), z = uniform(random, -size, size);
  return {x, y, z};
}

/// Uniform on the unit sphere.
inline Vector_3 uniform_direction(Random& random) {
  for (;;) {
    const Vector_3 v = uniform_vector(random, 1);
    const double square = v.squared_length();
    if (square > 0.01 && square < 1)
      return v / std::sqrt(square);
  }
}

/// A rotation and a shift, in doubles: what was coplanar is so to within an ulp only.
struct Rigid_motion {
  std::array<std::array<double, 3>, 3> matrix = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vector_3 shift{0, 0, 0};

  static Rigid_motion random(Random& random) {
    std::array<double, 4> q;
    double square;
    do {
      square = 0;
      for (double& x : q) {
        x = uniform(random, -1, 1);
        square += x * x;
      }
    } while (square > 1 || square < 0.01);
    for (double& x : q)
      x /= std::sqrt(square);
    const auto [w, x, y, z] = q;
    Rigid_motion motion;
    motion.matrix = {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                      {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                      {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
    motion.shift = uniform_vector(random, 1);
    return motion;
  }

  Point_3 operator()(const Point_3& p) const {
    const auto row = [&](int i) { return matrix[i][0] * p.x() + matrix[i][1] * p.y() + matrix[i][2] * p.z(); };
    return Point_3(row(0), row(1), row(2)) + shift;
  }
};

/// Two tetrahedra: the corners of the first, then those of the second, whose corner 4 is dragged.
inline meshes::Triangle_list two_tetrahedra(const std::array<Point_3, 8>& p) {
  meshes::Triangle_list list = meshes::tetrahedron();
  list += meshes::tetrahedron();
  for (int i = 0; i < 8; ++i)
    list.points[i] = p[i];
  return list;
}

/// A tetrahedron below z = 0 with a wide face in that plane.
inline meshes::Triangle_list slab() {
  meshes::Triangle_list list = meshes::tetrahedron();
  list.points = {{-8, -8, 0}, {8, -8, 0}, {0, 8, 0}, {0, 0, -3}};
  return list;
}

/// A block below z = 0 with a groove along y, `width` to both sides and `depth` deep. Faces 0 and 1 are the groove's
/// left side (x < 0), faces 2 and 3 its right one.
inline meshes::Triangle_list groove(double width, double depth) {
  meshes::Triangle_list list;
  constexpr double y = 8;
  const std::array<std::array<double, 2>, 7> outline = {
      {{-8, 0}, {-width, 0}, {0, -depth}, {width, 0}, {8, 0}, {8, -5}, {-8, -5}}};
  for (const double side : {-y, y})
    for (const auto& p : outline)
      list.add_point(p[0], side, p[1]);
  const auto strip = [&](std::size_t i) { list.add_quadrangle(i, (i + 1) % 7, (i + 1) % 7 + 7, i + 7); };
  for (const std::size_t i : {1, 2, 0, 3, 4, 5, 6})
    strip(i);
  for (const auto& f : {std::array<std::size_t, 3>{6, 5, 2}, {6, 2, 1}, {6, 1, 0}, {5, 3, 2}, {5, 4, 3}}) {
    list.add_face(f[0], f[1], f[2]);
    list.add_face(f[0] + 7, f[2] + 7, f[1] + 7);
  }
  return list;
}

/// A tetrahedral block below z = 0 with a three-sided pit: the rim in the plane z = 0, the bottom at `bottom`. Faces 0,
/// 1, 2 are the sides of the pit.
inline meshes::Triangle_list pit(const std::array<Point_3, 3>& rim, const Point_3& bottom) {
  meshes::Triangle_list list;
  list.points = {rim[0], rim[1], rim[2], bottom, {16, 0, 0}, {-8, 14, 0}, {-8, -14, 0}, {0, 0, -14}};
  for (std::size_t i = 0; i < 3; ++i)
    list.add_face(i, (i + 1) % 3, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    list.add_quadrangle(4 + i, 4 + j, j, i);
    list.add_face(4 + j, 4 + i, 7);
  }
  return list;
}

/// A square plate below z = 0, 2 wide, its top cut into n x n cells of two coplanar triangles.
inline meshes::Triangle_list plate(std::size_t n) {
  meshes::Triangle_list list;
  const auto at = [&](std::size_t i, std::size_t j) { return i * (n + 1) + j; };
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= n; ++j)
      list.add_point(2.0 * static_cast<double>(i) / static_cast<double>(n) - 1,
                     2.0 * static_cast<double>(j) / static_cast<double>(n) - 1, 0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      list.add_quadrangle(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  const std::size_t bottom = list.add_point(0, 0, -1);
  for (std::size_t k = 0; k < n; ++k) {
    list.add_face(at(k + 1, 0), at(k, 0), bottom);
    list.add_face(at(n, k + 1), at(n, k), bottom);
    list.add_face(at(k, n), at(k + 1, n), bottom);
    list.add_face(at(0, k), at(0, k + 1), bottom);
  }
  return list;
}

/// How the dragged vertex looks.
enum class Mover { probe, tetrahedron, bipyramid };

inline const char* name_of(Mover mover) {
  constexpr const char* names[] = {"probe", "tip", "star"};
  return names[static_cast<int>(mover)];
}

/// Adds to the list a vertex at `start`, alone or as the tip of a small solid whose other vertices lie around `base`,
/// and tells its index. \param width of the base
inline std::size_t add_mover(meshes::Triangle_list& list, Mover mover, const Point_3& start, const Point_3& base,
                             double width) {
  if (mover == Mover::probe)
    return list.add_point(start.x(), start.y(), start.z());
  const std::size_t valence = mover == Mover::tetrahedron ? 3 : 6;
  const Vector_3 axis = (base - start) / std::sqrt(CGAL::squared_distance(base, start));
  Vector_3 u = CGAL::cross_product(axis, std::abs(axis.x()) < 0.6 ? Vector_3(1, 0, 0) : Vector_3(0, 1, 0));
  u = u / std::sqrt(u.squared_length());
  const Vector_3 v = CGAL::cross_product(axis, u);
  meshes::Triangle_list solid;
  for (std::size_t i = 0; i < valence; ++i) {
    const double angle = 6.283185307179586 * (static_cast<double>(i) + 0.1) / static_cast<double>(valence);
    solid.points.push_back(base + width * std::cos(angle) * u + width * std::sin(angle) * v);
  }
  const std::size_t tip = solid.points.size();
  solid.points.push_back(start);
  for (std::size_t i = 0; i < valence; ++i)
    solid.add_face((i + 1) % valence, i, tip);
  if (mover == Mover::tetrahedron)
    solid.add_face(0, 1, 2);
  else {
    solid.points.push_back(base + 0.5 * width * axis);
    for (std::size_t i = 0; i < valence; ++i)
      solid.add_face(i, (i + 1) % valence, tip + 1);
  }
  const std::size_t offset = list.points.size();
  list += solid;
  return offset + tip;
}

/// The surface alone: vertices without faces are where probes begin. All others keep their indices.
inline Mesh without_probes(Mesh mesh) {
  std::vector<Vertex_index> probes;
  for (const Vertex_index v : mesh.vertices())
    if (mesh.is_isolated(v))
      probes.push_back(v);
  for (const Vertex_index v : probes)
    mesh.remove_vertex(v);
  return mesh;
}

/// \throw std::logic_error where the scene is not what it should be: a fault of the scene
inline Mesh valid_mesh(const meshes::Triangle_list& list, const std::string& name) {
  Mesh mesh = meshes::to_mesh(list);
  const Validity_report report = validate(without_probes(mesh));
  if (!report.is_valid())
    throw std::logic_error(name + ": " + report.message());
  return mesh;
}

} // namespace haptic_sculpt::test
