// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Small meshes on a grid with places for probes, and where these lie, by decisions over integers that share nothing
/// with the library.

#include "sculpting/motion/embedding_oracle_input.h"

#include "oracle/winding_oracle.h"

namespace haptic_sculpt::test {

enum class Side { outside, inside, on };

/// The mesh as it is, by index. \pre no garbage, or only vertices that no face has
inline oracle::Mesh_list to_oracle(const Mesh& mesh) {
  oracle::Mesh_list result;
  for (std::size_t i = 0; i < mesh.num_vertices(); ++i) {
    const Point_3& p = mesh.point(Vertex_index(static_cast<Mesh::size_type>(i)));
    result.points.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : mesh.faces()) {
    const auto corners = internal::corners_of_face(mesh, f);
    result.faces.push_back({static_cast<int>(corners[0]), static_cast<int>(corners[1]), static_cast<int>(corners[2])});
  }
  return result;
}

/// On which side of the faces a point lies: by the parity of how often they wind around it.
inline Side side_of(oracle::Mesh_list list, const Point_3& p) {
  list.points.push_back({p.x(), p.y(), p.z()});
  const auto points = oracle::scaled_to_integers(list.points);
  const int last = static_cast<int>(points.size()) - 1;
  const oracle::Still_signs<mpz_class> signs{points};
  for (const auto& f : list.faces)
    if (oracle::point_in_triangle(signs, last, f[0], f[1], f[2]))
      return Side::on;
  static std::mt19937 rays(1);
  return oracle::winding_number(points, list.faces, last, rays) % 2 != 0 ? Side::inside : Side::outside;
}

/// In the middle of four of these points: mostly within what they are the corners of.
inline Point_3 random_place_among(Random& random, const std::vector<Point_3>& points) {
  const auto any = [&] { return points[random() % points.size()]; };
  return CGAL::midpoint(CGAL::midpoint(any(), any()), CGAL::midpoint(any(), any()));
}

/// Among the points, or on whole grid points, halves and quarters about them, often in line with vertices.
inline Point_3 random_place_about(Random& random, int size, const std::vector<Point_3>& points) {
  if (random() % 2 == 0)
    return random_place_among(random, points);
  const double unit = random() % 3 == 0 ? 1 : random() % 2 == 0 ? 0.5 : 0.25;
  const Point_3 p = random_grid_point(random, static_cast<int>((size + 1) / unit));
  return {p.x() * unit, p.y() * unit, p.z() * unit};
}

/// A place that is not on the surface.
inline Point_3 random_place_off(Random& random, int size, const meshes::Triangle_list& list) {
  for (;;)
    if (const Point_3 p = random_place_about(random, size, list.points); side_of(to_oracle(list), p) != Side::on)
      return p;
}

} // namespace haptic_sculpt::test
