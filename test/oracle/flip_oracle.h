// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Can an edge be flipped? Decided by integers over all faces and all vertices. Uses nothing of the library and nothing
/// of CGAL.

#include <oracle/embedding_oracle.h>

namespace oracle {

/// What stands in the way of a flip of AB to CD, in this order; `none` is said of those that bend the surface,
/// `none_flat` of those that do not.
enum class Flip_obstacle {
  none,
  none_flat,
  joined,
  degenerate,
  low,
  folded,
  vertex_inside,
  face_crossed
};

constexpr const char* flip_obstacle_names[] = {
    "free",          "free in a plane",        "joined",      "degenerate", "low", "folded",
    "vertex inside", "face crossed"};

/// The altitude over the longest edge against a rational length, all in the unit of the integers.
template <class Integer>
bool is_low(const Point<Integer>& a, const Point<Integer>& b, const Point<Integer>& c, const mpq_class& delta) {
  const auto minus = [](const Point<Integer>& p, const Point<Integer>& q) {
    return std::array<mpz_class, 3>{to_mpz(Integer(p[0] - q[0])), to_mpz(Integer(p[1] - q[1])),
                                    to_mpz(Integer(p[2] - q[2]))};
  };
  const auto square = [](const std::array<mpz_class, 3>& v) {
    return mpz_class(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  };
  const auto u = minus(b, a), v = minus(c, a), w = minus(c, b);
  const std::array<mpz_class, 3> n = {mpz_class(u[1] * v[2] - u[2] * v[1]), mpz_class(u[2] * v[0] - u[0] * v[2]),
                                      mpz_class(u[0] * v[1] - u[1] * v[0])};
  const mpz_class longest = std::max({square(u), square(v), square(w)});
  return mpq_class(square(n)) < mpq_class(delta * delta * longest);
}

/// Whether p is in the closed convex hull of four points.
template <class Signs>
bool in_hull_of_four(const Signs& signs, int p, int a, int b, int c, int d) {
  const int volume = signs.orient_3(a, b, c, d);
  if (volume != 0)
    return signs.orient_3(p, b, c, d) * volume >= 0 && signs.orient_3(a, p, c, d) * volume >= 0 &&
           signs.orient_3(a, b, p, d) * volume >= 0 && signs.orient_3(a, b, c, p) * volume >= 0;
  // A point of a flat hull is in one of its triangles.
  for (const auto& t :
       {Corner_indices{a, b, c}, Corner_indices{a, b, d}, Corner_indices{a, c, d}, Corner_indices{b, c, d}})
    if (on_one_line(signs, t[0], t[1], t[2])
            ? point_on_segment(signs, p, t[0], t[1]) || point_on_segment(signs, p, t[1], t[2])
            : point_in_triangle(signs, p, t[0], t[1], t[2]))
      return true;
  return false;
}

/// Of the edge ab between two faces whose other corners are c and d. \pre the mesh is embedded
/// \param delta in the unit of the integers
template <class Integer>
Flip_obstacle flip_obstacle(const std::vector<Point<Integer>>& points, const std::vector<Corner_indices>& faces, int a,
                            int b, int c, int d, const mpq_class& delta) {
  const Still_signs<Integer> signs{points};
  const auto has_both = [](const Corner_indices& face, int v, int w) {
    return std::count(face.begin(), face.end(), v) + std::count(face.begin(), face.end(), w) == 2;
  };
  for (const Corner_indices& face : faces)
    if (has_both(face, c, d))
      return Flip_obstacle::joined;
  const Corner_indices first = {a, d, c}, second = {b, c, d};
  for (const Corner_indices& t : {first, second}) {
    if (on_one_line(signs, t[0], t[1], t[2]))
      return Flip_obstacle::degenerate;
    if (is_low(points[t[0]], points[t[1]], points[t[2]], delta))
      return Flip_obstacle::low;
  }
  if (triangles_meet_improperly(signs, first, second))
    return Flip_obstacle::folded;
  // What is beyond all four corners along an axis is in no tetrahedron and no face of them.
  const auto is_beyond = [&](int p, int axis, int way) {
    for (const int corner : {a, b, c, d})
      if (signs.compare(axis, p, corner) * way <= 0)
        return false;
    return true;
  };
  const auto is_apart = [&](const auto& vertices) {
    for (int axis = 0; axis < 3; ++axis)
      for (const int way : {-1, 1})
        if (std::all_of(vertices.begin(), vertices.end(), [&](int p) { return is_beyond(p, axis, way); }))
          return true;
    return false;
  };
  for (int p = 0; p < static_cast<int>(points.size()); ++p)
    if (p != a && p != b && p != c && p != d && !is_apart(std::array<int, 1>{p}) &&
        in_hull_of_four(signs, p, a, b, c, d))
      return Flip_obstacle::vertex_inside;
  for (const Corner_indices& face : faces)
    if (!has_both(face, a, b) && !is_apart(face) &&
        (triangles_meet_improperly(signs, first, face) || triangles_meet_improperly(signs, second, face)))
      return Flip_obstacle::face_crossed;
  return signs.orient_3(a, b, c, d) == 0 ? Flip_obstacle::none_flat : Flip_obstacle::none;
}

} // namespace oracle
