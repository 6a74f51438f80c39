// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sculpting/public_functions/Outcome.h"

namespace haptic_sculpt::test {

/// An uneven ball and a moon beside it, in coordinates of 20 binary places times a power of two. So all of it is
/// exact, down to subnormal numbers, and no coordinate is larger than twice the unit. What is asked of it is worked out
/// in the usual mode, whatever that of the caller.
struct Scaled_scene {
  double unit;
  Mesh mesh;

  explicit Scaled_scene(double unit) : unit(unit) {
    const internal::Rounding_to_nearest rounding;
    meshes::Triangle_list list = meshes::bumpy_sphere(1, 0.2);
    list += meshes::tetrahedron(0.5).transform(
        [](const Point_3& p) { return Point_3(p.x() + 1.25, p.y(), p.z() + 0.125); });
    mesh = meshes::to_mesh(list);
    for (const Vertex_index v : mesh.vertices()) {
      const Point_3 p = mesh.point(v);
      mesh.point(v) = at(on_grid(p.x()), on_grid(p.y()), on_grid(p.z()));
    }
  }

  double length(double x) const {
    const internal::Rounding_to_nearest rounding;
    return computed(x * unit);
  }
  Point_3 at(double x, double y, double z) const { return {length(x), length(y), length(z)}; }
  Point_3 middle(Vertex_index v, Vertex_index w) const {
    const internal::Rounding_to_nearest rounding;
    const Point_3 p = CGAL::midpoint(mesh.point(v), mesh.point(w));
    return {computed(p.x()), computed(p.y()), computed(p.z())};
  }
  /// Where a vertex of the ball would be, this many times as far from the origin, and this many units along x.
  Point_3 beyond(Vertex_index v, double share, double along = 0) const {
    const internal::Rounding_to_nearest rounding;
    const Point_3& p = mesh.point(v);
    return {computed(p.x() * share + along * unit), computed(p.y() * share), computed(p.z() * share)};
  }
  static Vertex_index vertex(std::size_t i) { return Vertex_index(static_cast<Mesh::size_type>(i)); }
  /// Worked out here: else a compiler, to which all modes are one, does so where it is used, in the caller's mode.
  static double computed(double x) {
    const volatile double here = x;
    return here;
  }
  static constexpr std::size_t ball_size = 42;

private:
  static double on_grid(double x) { return std::ldexp(std::rint(std::ldexp(0.75 * x, 20)), -20); }
};

} // namespace haptic_sculpt::test
