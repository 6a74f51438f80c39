// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Meshes with one fault each, as programs that draw or scan make them.

#include <meshes/generated_meshes.h>

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace meshes {

/// A ball of which a disc of faces is missing.
inline Triangle_list ball_with_a_hole() {
  Triangle_list list = icosphere(3);
  list.faces.erase(std::remove_if(list.faces.begin(), list.faces.end(),
                                  [&](const auto& f) {
                                    return std::all_of(f.begin(), f.end(),
                                                       [&](std::size_t v) { return list.points[v].z() > 0.8; });
                                  }),
                   list.faces.end());
  return list;
}

/// Each face has corners of its own, each coordinate off by at most `gap` / 4: corners of one vertex are less than
/// `gap` apart.
inline Triangle_list soup_with_gaps(const Triangle_list& whole, double gap, std::uint32_t seed = 7) {
  std::mt19937 random(seed);
  const auto off = [&] { return gap / 4 * (random() / 2147483648.0 - 1); };
  Triangle_list list;
  for (const auto& f : whole.faces) {
    for (const std::size_t v : f) {
      const double x = off(), y = off(), z = off();
      list.add_point(whole.points[v].x() + x, whole.points[v].y() + y, whole.points[v].z() + z);
    }
    const std::size_t n = list.points.size();
    list.add_face(n - 3, n - 2, n - 1);
  }
  return list;
}

/// Two balls beside each other, one inside out.
inline Triangle_list flipped_component() {
  Triangle_list list = icosphere(2), other = icosphere(2);
  return list += other.turn_inside_out().scale_and_move(1, 3, 0, 0);
}

/// Two tetrahedra that share a vertex.
inline Triangle_list pinched_vertex() {
  Triangle_list list = nearly_pinched(1);
  for (auto& f : list.faces)
    for (std::size_t& v : f)
      v = v == 7 ? 3 : v;
  list.points.pop_back();
  return list;
}

/// A ball of which a part is there twice, with points of its own, the second time turned over or not.
inline Triangle_list doubled_sheet(bool turned) {
  Triangle_list list = icosphere(2), sheet = icosphere(2);
  sheet.faces.resize(60);
  if (turned)
    sheet.turn_inside_out();
  return list += sheet;
}

inline Triangle_list overlapping_balls(int level = 2) {
  Triangle_list list = icosphere(level), other = icosphere(level);
  return list += other.scale_and_move(0.75, 1, 0.125, 0.0625);
}

/// A ball, and points without faces, one of them far away.
inline Triangle_list stray_vertices() {
  Triangle_list list = icosphere(2);
  list.points.insert(list.points.begin() + 5, Point_3(100, 0, 0));
  for (auto& f : list.faces)
    for (std::size_t& v : f)
      v += v >= 5;
  list.add_point(0, 0, 0);
  return list;
}

/// A box of cells, with a face that has a corner twice, and an edge into whose middle a vertex was put on one side
/// only, with a triangle of no area between.
inline Triangle_list degenerate_faces() {
  Triangle_list list = box(3, 3);
  const auto f = list.faces[0];
  const Point_3 p = list.points[f[0]], q = list.points[f[1]];
  const std::size_t middle = list.add_point((p.x() + q.x()) / 2, (p.y() + q.y()) / 2, (p.z() + q.z()) / 2);
  list.faces[0] = {f[0], middle, f[2]};
  list.add_face(middle, f[1], f[2]);
  list.add_face(f[0], f[1], middle);
  list.add_face(4, 4, 5);
  return list;
}

/// Faces of a ball, every third turned over.
inline Triangle_list turned_faces() {
  Triangle_list list = icosphere(2);
  for (std::size_t f = 0; f < list.faces.size(); f += 3)
    std::swap(list.faces[f][1], list.faces[f][2]);
  return list;
}

/// Two cubes that share an edge.
inline Triangle_list cubes_on_an_edge() {
  Triangle_list list = cube(), other = cube();
  return list += other.scale_and_move(1, 1, 1, 0); // with points of its own
}

/// Two boxes side on side; the one is larger, so that no face fits another.
inline Triangle_list boxes_side_on_side() {
  Triangle_list list = box(2, 2), other = box(2, 3);
  return list += other.scale_and_move(1, 2, -0.5, -0.25);
}

/// A box with a wall in it, from side to side.
inline Triangle_list box_with_a_wall() {
  Triangle_list list = box(2, 2);
  const std::size_t middle = list.add_point(1, 1, 1);
  const int ring[9][2] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}, {0, 0}};
  const auto at = [&](int i) {
    const Point_3 p(ring[i][0], ring[i][1], 1);
    return static_cast<std::size_t>(std::find(list.points.begin(), list.points.end(), p) - list.points.begin());
  };
  for (int i = 0; i < 8; ++i)
    list.add_face(at(i), at(i + 1), middle);
  return list;
}

/// A ball and a loose triangle.
inline Triangle_list loose_triangle() {
  Triangle_list list = icosphere(2);
  const std::size_t a = list.add_point(0, 0, 0), b = list.add_point(0.25, 0, 0), c = list.add_point(0, 0.25, 0.125);
  list.add_face(a, b, c);
  return list;
}

/// What is to come through repair(), by name.
inline std::vector<std::pair<std::string, Triangle_list>> broken_meshes() {
  return {{"hole", ball_with_a_hole()},
          {"soup with gaps of 1e-7", soup_with_gaps(bumpy_sphere(3), 1e-7)},
          {"component turned over", flipped_component()},
          {"pinched vertex", pinched_vertex()},
          {"doubled sheet", doubled_sheet(false)},
          {"doubled sheet, turned over", doubled_sheet(true)},
          {"overlapping balls", overlapping_balls()},
          {"stray vertices", stray_vertices()},
          {"degenerate faces", degenerate_faces()},
          {"faces turned over", turned_faces()},
          {"soup without gaps", soup_with_gaps(torus(12, 8), 0)},
          {"cubes on an edge", cubes_on_an_edge()},
          {"boxes side on side", boxes_side_on_side()},
          {"box with a wall inside", box_with_a_wall()},
          {"ball and a loose triangle", loose_triangle()}};
}

} // namespace meshes
