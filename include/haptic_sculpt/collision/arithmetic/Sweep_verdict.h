// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/exact_integers.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace haptic_sculpt {

/// Where on the static triangle A, B, C a vertex-face impact happens; exact.
enum class Triangle_location : std::uint8_t {
  face,     ///< inside of it, on no edge
  edge_ab,  ///< between A and B
  edge_bc,  ///< between B and C
  edge_ca,  ///< between C and A
  vertex_a, ///< at A
  vertex_b, ///< at B
  vertex_c  ///< at C
};

/// E.g. "face", "edge-ab" or "vertex-c".
inline const char* name_of(Triangle_location location) {
  constexpr const char* names[] = {"face", "edge-ab", "edge-bc", "edge-ca", "vertex-a", "vertex-b", "vertex-c"};
  return names[static_cast<int>(location)];
}

namespace internal {

/// The five points of a sweep: start and target of the moving vertex, then the static points in the functor's order.
using Sweep_points = std::array<Coordinates, 5>;

/// What makes an affine function along the path that vanishes at the time of impact.
enum class Time_form : std::uint8_t {
  at_start, ///< the time is 0
  plane,    ///< the moving vertex enters the plane of three static points
  line,     ///< in a plane, dropped to coordinates without `axis`: it enters the line of two static points
  point     ///< on a line, along coordinate `axis`: it reaches a static point
};

/// The answer of a sweep: a few bytes, and with the five points everything there is to know about the impact.
struct Sweep_verdict {
  bool hits = false;
  Time_form form = Time_form::at_start;
  std::uint8_t axis = 0;
  std::array<std::uint8_t, 3> through{}; ///< indices into Sweep_points of the plane's, line's or point's static points
  Triangle_location location = Triangle_location::face; ///< vertex-face sweeps only
};

template <class Point_3>
Coordinates coordinates(const Point_3& p) {
  return {p.x(), p.y(), p.z()};
}

template <class Point_3>
Sweep_points sweep_points(const Point_3& s, const Point_3& t, const Point_3& a, const Point_3& b, const Point_3& c) {
  return {coordinates(s), coordinates(t), coordinates(a), coordinates(b), coordinates(c)};
}

template <std::size_t size>
bool are_finite(const std::array<Coordinates, size>& points) {
  for (const Coordinates& p : points)
    for (double x : p)
      if (!std::isfinite(x))
        return false;
  return true;
}

} // namespace internal

} // namespace haptic_sculpt
