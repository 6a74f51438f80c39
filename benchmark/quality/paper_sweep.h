// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Sweep_answer.h"
#include "Vector_of_numbers.h"
#include "oracle/Sweep_kind.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace haptic_sculpt::benchmark {

/// The three tests of Yeung and Petriu (1997, 3.2.1) in doubles, as a careful programmer of their day would have coded
/// them: parameters are solved for and compared with 0 and 1 but for an epsilon, lengths with 0 but for the same
/// number; a tiny motion is decided by projecting S on the plane.
class Paper_sweep {
public:
  /// For parameters (no unit) and for lengths (unit of the scene, taken to be about 1): far above the rounding of
  /// doubles, far below any feature of a scene. The paper names none.
  static constexpr double epsilon = 1e-9;

  Paper_sweep(test::Sweep_kind kind, const test::Sweep_coordinates& x) : m_kind(kind) {
    for (int i = 0; i < 5; ++i)
      p[i] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
  }

  Sweep_answer operator()() const {
    const std::optional<double> time = m_kind == test::Sweep_kind::vertex_face
                                           ? vertex_on_triangle(p[0], p[1], p[2], p[3], p[4])
                                       : m_kind == test::Sweep_kind::edge_edge ? edge_on_edge()
                                                                               : face_on_vertex();
    return time ? Sweep_answer{true, std::clamp(*time, 0., 1.)} : Sweep_answer{};
  }

private:
  using Vector = Vector_of_numbers<double>;

  static double length(const Vector& a) { return std::sqrt(dot(a, a)); }
  static bool is_parameter(double u) { return u >= -epsilon && u <= 1 + epsilon; }

  /// Weights of B and C of a point of the plane of ABC, whose normal is given.
  static std::pair<double, double> weights(const Vector& q, const Vector& a, const Vector& b, const Vector& c,
                                           const Vector& normal) {
    const double area = dot(normal, normal);
    return {dot(normal, cross(q - a, c - a)) / area, dot(normal, cross(b - a, q - a)) / area};
  }

  static bool is_inside(const std::pair<double, double>& w) {
    return w.first >= -epsilon && w.second >= -epsilon && w.first + w.second <= 1 + epsilon;
  }

  /// Test (I): the parameter on ST of its meeting with the triangle.
  static std::optional<double> vertex_on_triangle(const Vector& s, const Vector& t, const Vector& a, const Vector& b,
                                                  const Vector& c) {
    const Vector normal = cross(b - a, c - a);
    const double start = dot(s - a, normal) / length(normal), end = dot(t - a, normal) / length(normal);
    if ((start > epsilon && end > epsilon) || (start < -epsilon && end < -epsilon))
      return std::nullopt;
    if (length(t - s) <= epsilon) // too short to solve for: does the projection of S lie in the triangle?
      return is_inside(weights(s, a, b, c, normal)) ? std::optional<double>(0) : std::nullopt;
    if (std::abs(start) <= epsilon && std::abs(end) <= epsilon)
      return first_of_edges(s, t, {a, b, c}, normal);
    const double u = start / (start - end);
    if (!is_parameter(u) || !is_inside(weights(s + u * (t - s), a, b, c, normal)))
      return std::nullopt;
    return u;
  }

  /// ST in the plane: against each edge in turn.
  static std::optional<double> first_of_edges(const Vector& s, const Vector& t, const Vector (&corner)[3],
                                              const Vector& normal) {
    std::optional<double> first;
    for (int i = 0; i < 3; ++i) {
      const Vector &a = corner[i], &b = corner[(i + 1) % 3];
      const double determinant = dot(normal, cross(t - s, b - a));
      const double u = dot(normal, cross(a - s, b - a)) / determinant,
                   v = dot(normal, cross(a - s, t - s)) / determinant;
      if (is_parameter(u) && is_parameter(v) && (!first || u < *first))
        first = u;
    }
    return first;
  }

  /// Test (II): G where AB meets the triangle STV; J stops where the line ST meets the line VG.
  std::optional<double> edge_on_edge() const {
    const std::optional<double> along = vertex_on_triangle(p[3], p[4], p[0], p[1], p[2]);
    if (!along)
      return std::nullopt;
    const Vector g = p[3] + *along * (p[4] - p[3]);
    const auto [t, v] = weights(g, p[0], p[1], p[2], cross(p[1] - p[0], p[2] - p[0]));
    return 1 - v <= epsilon ? 0 : t / (1 - v);
  }

  /// Test (III): A on the inner side of all four planes, or on them; J stops where ST meets the plane GIA.
  std::optional<double> face_on_vertex() const {
    for (int i = 0; i < 4; ++i) {
      const Vector &a = p[(i + 1) % 4], &b = p[(i + 2) % 4], &c = p[(i + 3) % 4];
      Vector normal = cross(b - a, c - a);
      const double size = length(normal);
      const double inner = dot(normal, p[i] - a) / size, distance = dot(normal, p[4] - a) / size;
      if (inner >= 0 ? distance < -epsilon : distance > epsilon)
        return std::nullopt;
    }
    const Vector normal = cross(p[3] - p[2], p[4] - p[2]);
    const double start = dot(normal, p[0] - p[2]), end = dot(normal, p[1] - p[2]);
    return start == end ? 0 : start / (start - end);
  }

  test::Sweep_kind m_kind;
  Vector p[5];
};

} // namespace haptic_sculpt::benchmark
