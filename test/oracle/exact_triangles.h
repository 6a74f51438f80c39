// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// How closed triangles meet, over integers. Uses nothing of the library and nothing of CGAL.

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

namespace oracle {

using Corner_indices = std::array<int, 3>;

/// A triangle mesh as a list.
struct Mesh_list {
  std::vector<std::array<double, 3>> points;
  std::vector<Corner_indices> faces;
};

template <class Integer>
using Point = std::array<Integer, 3>;

inline int sign_of(const mpz_class& x) {
  return sgn(x);
}
inline int sign_of(__int128 x) {
  return (x > 0) - (x < 0);
}

template <class Integer>
Integer determinant_3(const Point<Integer>& a, const Point<Integer>& b, const Point<Integer>& c,
                      const Point<Integer>& d) {
  const Integer x1 = b[0] - a[0], y1 = b[1] - a[1], z1 = b[2] - a[2];
  const Integer x2 = c[0] - a[0], y2 = c[1] - a[1], z2 = c[2] - a[2];
  const Integer x3 = d[0] - a[0], y3 = d[1] - a[1], z3 = d[2] - a[2];
  return x1 * (y2 * z3 - z2 * y3) - y1 * (x2 * z3 - z2 * x3) + z1 * (x2 * y3 - y2 * x3);
}

/// Of the projections that drop coordinate `axis`.
template <class Integer>
Integer determinant_2(int axis, const Point<Integer>& a, const Point<Integer>& b, const Point<Integer>& c) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  return (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
}

/// The signs by which everything below is decided, of points that stand still. Points go by their index.
template <class Integer>
struct Still_signs {
  const std::vector<Point<Integer>>& points;

  int orient_3(int a, int b, int c, int d) const {
    return sign_of(determinant_3(points[a], points[b], points[c], points[d]));
  }
  int orient_2(int axis, int a, int b, int c) const {
    return sign_of(determinant_2(axis, points[a], points[b], points[c]));
  }
  int compare(int axis, int a, int b) const { return sign_of(Integer(points[a][axis] - points[b][axis])); }
};

template <class Signs>
bool same_point(const Signs& signs, int a, int b) {
  return signs.compare(0, a, b) == 0 && signs.compare(1, a, b) == 0 && signs.compare(2, a, b) == 0;
}

template <class Signs>
bool on_one_line(const Signs& signs, int a, int b, int c) {
  return signs.orient_2(0, a, b, c) == 0 && signs.orient_2(1, a, b, c) == 0 && signs.orient_2(2, a, b, c) == 0;
}

/// Whether p lies on the closed segment ab, which may be a point.
template <class Signs>
bool point_on_segment(const Signs& signs, int p, int a, int b) {
  if (!on_one_line(signs, a, b, p))
    return false;
  for (int axis = 0; axis < 3; ++axis)
    if (signs.compare(axis, p, a) * signs.compare(axis, p, b) > 0)
      return false;
  return !same_point(signs, a, b) || same_point(signs, p, a);
}

/// Whether two closed segments in space meet; either may be a point.
template <class Signs>
bool segments_meet(const Signs& signs, int p, int q, int a, int b) {
  if (signs.orient_3(p, q, a, b) != 0)
    return false;
  if (point_on_segment(signs, p, a, b) || point_on_segment(signs, q, a, b) || point_on_segment(signs, a, p, q) ||
      point_on_segment(signs, b, p, q))
    return true;
  // Coplanar and no end on the other: they meet iff they cross, seen along an axis in which the plane is not on edge.
  for (int axis = 0; axis < 3; ++axis) {
    const int pa = signs.orient_2(axis, p, q, a), pb = signs.orient_2(axis, p, q, b),
              ap = signs.orient_2(axis, a, b, p), aq = signs.orient_2(axis, a, b, q);
    if (pa == 0 && pb == 0 && ap == 0 && aq == 0)
      continue;
    return pa * pb < 0 && ap * aq < 0;
  }
  return false; // all on one line, and no end on the other segment
}

/// Whether p lies in the closed triangle abc. \pre abc is not degenerate
template <class Signs>
bool point_in_triangle(const Signs& signs, int p, int a, int b, int c) {
  if (signs.orient_3(a, b, c, p) != 0)
    return false;
  for (int axis = 0; axis < 3; ++axis) {
    const int o = signs.orient_2(axis, a, b, c);
    if (o != 0)
      return signs.orient_2(axis, a, b, p) * o >= 0 && signs.orient_2(axis, b, c, p) * o >= 0 &&
             signs.orient_2(axis, c, a, p) * o >= 0;
  }
  throw std::logic_error("point_in_triangle: degenerate triangle");
}

/// Whether the closed segment pq meets the closed triangle abc. \pre neither is degenerate
template <class Signs>
bool segment_meets_triangle(const Signs& signs, int p, int q, int a, int b, int c) {
  const int at_p = signs.orient_3(a, b, c, p), at_q = signs.orient_3(a, b, c, q);
  if (at_p * at_q > 0)
    return false;
  if (at_p == 0 && at_q == 0)
    return point_in_triangle(signs, p, a, b, c) || segments_meet(signs, p, q, a, b) ||
           segments_meet(signs, p, q, b, c) || segments_meet(signs, p, q, c, a);
  const int u = signs.orient_3(p, q, a, b), v = signs.orient_3(p, q, b, c), w = signs.orient_3(p, q, c, a);
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

/// Puts the vertices that two faces share to the front of both, in the same order; returns their number.
inline std::size_t shared_to_front(Corner_indices& f, Corner_indices& g) {
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = shared; j < 3; ++j)
      if (f[i] == g[j]) {
        std::swap(f[i], f[shared]);
        std::swap(g[j], g[shared]);
        ++shared;
        break;
      }
  return shared;
}

/// Whether two closed triangles meet elsewhere than in the vertices (told by index) and the edge they share.
/// No sign is asked of the same point twice. \pre neither is degenerate
template <class Signs>
bool triangles_meet_improperly(const Signs& signs, Corner_indices f, Corner_indices g) {
  const std::size_t shared = shared_to_front(f, g);
  if (shared == 3)
    return true;
  if (shared == 2) {
    if (signs.orient_3(f[0], f[1], f[2], g[2]) != 0)
      return false;
    for (int axis = 0; axis < 3; ++axis) {
      const int o = signs.orient_2(axis, f[0], f[1], f[2]);
      if (o != 0)
        return o == signs.orient_2(axis, f[0], f[1], g[2]);
    }
    throw std::logic_error("triangles_meet_improperly: degenerate triangle");
  }
  if (shared == 1) // a common segment from the shared vertex ends on an opposite edge
    return segment_meets_triangle(signs, f[1], f[2], g[0], g[1], g[2]) ||
           segment_meets_triangle(signs, g[1], g[2], f[0], f[1], f[2]);
  // Where two triangles meet, an edge of one meets the other.
  for (int i = 0; i < 3; ++i)
    if (segment_meets_triangle(signs, f[i], f[(i + 1) % 3], g[0], g[1], g[2]) ||
        segment_meets_triangle(signs, g[i], g[(i + 1) % 3], f[0], f[1], f[2]))
      return true;
  return false;
}

/// The points times a common power of two that makes them integers. \pre finite coordinates
inline std::vector<Point<mpz_class>> scaled_to_integers(const std::vector<std::array<double, 3>>& points) {
  int lowest = 2000;
  for (const auto& p : points)
    for (const double x : p)
      if (x != 0) {
        int exponent;
        std::frexp(x, &exponent);
        lowest = std::min(lowest, std::max(exponent - 53, -1074));
      }
  std::vector<Point<mpz_class>> scaled(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (points[i][k] != 0) {
        int exponent;
        const double mantissa = std::ldexp(std::frexp(points[i][k], &exponent), 53); // an integer
        mpz_class n(mantissa);
        const int shift = exponent - 53 - lowest;
        if (shift >= 0)
          n <<= shift;
        else
          n >>= -shift; // subnormals: the bits dropped are zero
        scaled[i][k] = n;
      }
  // Fewer bits are faster: take out what is common.
  mp_bitcnt_t zeros = ~mp_bitcnt_t(0);
  for (const auto& p : scaled)
    for (const auto& x : p)
      if (x != 0)
        zeros = std::min(zeros, mpz_scan1(x.get_mpz_t(), 0));
  for (auto& p : scaled)
    for (auto& x : p)
      if (x != 0)
        x >>= zeros;
  return scaled;
}

/// All pairs of faces that are not degenerate and meet improperly.
inline std::vector<std::pair<int, int>> improper_pairs(const Mesh_list& mesh) {
  const auto points = scaled_to_integers(mesh.points);
  const Still_signs<mpz_class> signs{points};
  std::vector<bool> flat;
  for (const auto& f : mesh.faces)
    flat.push_back(on_one_line(signs, f[0], f[1], f[2]));
  std::vector<std::pair<int, int>> found;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (std::size_t g = f + 1; g < mesh.faces.size(); ++g)
      if (!flat[f] && !flat[g] && triangles_meet_improperly(signs, mesh.faces[f], mesh.faces[g]))
        found.emplace_back(f, g);
  return found;
}

} // namespace oracle
