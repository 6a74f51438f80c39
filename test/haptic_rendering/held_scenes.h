// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_rendering/random_vector.h"
#include "meshes/generated_meshes.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace haptic_rendering_tests {

using Eigen::Matrix3d;

inline meshes::Triangle_list tetrahedron_of(const std::array<Vector3d, 4>& corners) {
  meshes::Triangle_list list = meshes::tetrahedron();
  for (int i = 0; i < 4; ++i)
    list.points[i] = meshes::Point_3(corners[i][0], corners[i][1], corners[i][2]);
  if ((corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0]) < 0)
    list.turn_inside_out();
  return list;
}

/// What holds a point on one side of a plane.
struct Side {
  Vector3d place, normal;
  Side(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& inside)
      : place(a), normal((b - a).cross(c - a).normalized()) {
    if (normal.dot(inside - a) < 0)
      normal = -normal;
  }
  double height(const Vector3d& p) const { return normal.dot(p - place); }
  Vector3d nearest(const Vector3d& p) const { return height(p) >= 0 ? p : Vector3d(p - height(p) * normal); }
};

/// The point nearest to p on the right side of both planes.
inline Vector3d nearest_in_corner(const Side& a, const Side& b, const Vector3d& p) {
  if (b.height(a.nearest(p)) >= 0)
    return a.nearest(p);
  if (a.height(b.nearest(p)) >= 0)
    return b.nearest(p);
  Matrix3d equations;
  equations << a.normal.transpose(), b.normal.transpose(), a.normal.cross(b.normal).transpose();
  const Vector3d right(a.normal.dot(a.place), b.normal.dot(b.place), a.normal.cross(b.normal).dot(p));
  return equations.fullPivLu().solve(right);
}

/// A tetrahedron whose lowest vertex will be pulled down at x > 0, on a blade whose edge holds one of its edges, or on
/// a spike that holds one of its faces; a wall stands further out at x.
enum class Obstacle { edge, vertex };
struct Held_scene {
  std::array<Vector3d, 4> moving, obstacle, wall;
  Held_scene(Obstacle kind, Random& random) {
    const bool is_edge = kind == Obstacle::edge;
    obstacle = is_edge ? std::array<Vector3d, 4>{{{0, -2, 1}, {0, 2, 1}, {0.1, 0, -3}, {-0.1, 0, -3}}}
                       : std::array<Vector3d, 4>{{{0, 0, 1}, {0.1, 0.1, -3}, {-0.1, 0.1, -3}, {0, -0.1, -3}}};
    moving = is_edge ? std::array<Vector3d, 4>{{{1, 0, 1.6}, {-1, 0, 1.5}, {-0.2, 0.8, 2.7}, {-0.2, -0.8, 2.7}}}
                     : std::array<Vector3d, 4>{{{1, 0, 1.6}, {-1, 0.7, 1.5}, {-1, -0.7, 1.5}, {-0.5, 0, 3}}};
    wall = {{{1.3, -4, -4}, {1.3, 4, -4}, {1.3, 0, 6}, {6, 0, 0}}};
    const Matrix3d turned =
        Eigen::Quaterniond(Eigen::Vector4d(random_vector(random, 1).homogeneous()).normalized()).toRotationMatrix();
    for (auto* corners : {&moving, &obstacle, &wall})
      for (Vector3d& p : *corners)
        p = turned * (p + random_vector(random, 0.01));
    down = turned * Vector3d(0, 0, -1), out = turned * Vector3d(1, 0, 0), along = turned * Vector3d(0, 1, 0);
  }
  Vector3d down, out, along;
  /// The plane that the sweep of an edge or a face against what is held sees.
  Side held_side(Obstacle kind) const {
    return kind == Obstacle::edge ? Side(moving[1], obstacle[0], obstacle[1], moving[0])
                                  : Side(moving[1], moving[2], obstacle[0], moving[0]);
  }
  Side wall_side() const { return Side(wall[0], wall[1], wall[2], moving[0]); }
};

} // namespace haptic_rendering_tests
