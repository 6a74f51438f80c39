// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Sweep_answer.h"
#include "Vector_of_numbers.h"
#include "oracle/Sweep_kind.h"

#include <CGAL/Lazy_exact_nt.h>

#include <array>
#include <gmpxx.h>
#include <optional>

namespace haptic_sculpt::benchmark {

template <class Number> int sign_of(const Number& a) { return (a > 0) - (a < 0); }
inline int sign_of(const mpq_class& a) { return sgn(a); }
template <class Number> double as_double(const Number& a) { return static_cast<double>(a); }
inline double as_double(const mpq_class& a) { return a.get_d(); }
template <class Exact> int sign_of(const CGAL::Lazy_exact_nt<Exact>& a) { return static_cast<int>(CGAL::sign(a)); }
template <class Exact> double as_double(const CGAL::Lazy_exact_nt<Exact>& a) { return CGAL::to_double(CGAL::exact(a)); }

/// The sweeps as one would write them down from the paper: signs of determinants, u as their ratio, flat cases apart,
/// all in one number type. With exact numbers every answer is right; with rounded ones this shows what rounding costs.
template <class Number> class Determinant_sweep {
public:
  using Vector = Vector_of_numbers<Number>;

  Determinant_sweep(test::Sweep_kind kind, const test::Sweep_coordinates& x) : m_kind(kind) {
    for (int i = 0; i < 5; ++i)
      p[i] = {Number(x[3 * i]), Number(x[3 * i + 1]), Number(x[3 * i + 2])};
  }

  /// The first u, if any.
  std::optional<Number> operator()() const {
    switch (m_kind) {
    case test::Sweep_kind::vertex_face: return vertex_face();
    case test::Sweep_kind::edge_edge: return edge_edge();
    default: return face_vertex();
    }
  }

private:
  std::optional<Number> vertex_face() const {
    const Number start = orientation(p[2], p[3], p[4], p[0]), end = orientation(p[2], p[3], p[4], p[1]);
    if (sign_of(start) == 0 && sign_of(end) == 0)
      return first_flat();
    if (sign_of(start) * sign_of(end) > 0 || !passes(p[0], p[1], p[2], p[3], p[4]))
      return std::nullopt;
    return start / (start - end);
  }

  std::optional<Number> edge_edge() const {
    const int a = sign_of(orientation(p[0], p[1], p[2], p[3])), b = sign_of(orientation(p[0], p[1], p[2], p[4]));
    if (a == 0 && b == 0)
      return first_flat();
    if (a * b > 0 || !passes(p[3], p[4], p[0], p[1], p[2]))
      return std::nullopt;
    return time_through(p[2], p[3], p[4]);
  }

  std::optional<Number> face_vertex() const {
    const int side = sign_of(orientation(p[0], p[1], p[2], p[3]));
    if (side == 0)
      return first_flat();
    if (side * sign_of(orientation(p[4], p[1], p[2], p[3])) < 0 ||
        side * sign_of(orientation(p[0], p[4], p[2], p[3])) < 0 ||
        side * sign_of(orientation(p[0], p[1], p[4], p[3])) < 0 ||
        side * sign_of(orientation(p[0], p[1], p[2], p[4])) < 0)
      return std::nullopt;
    return time_through(p[2], p[3], p[4]);
  }

  /// Whether the line QR meets the triangle, edges included, if it is not in its plane.
  static bool passes(const Vector& q, const Vector& r, const Vector& a, const Vector& b, const Vector& c) {
    const int ab = sign_of(orientation(q, r, a, b)), bc = sign_of(orientation(q, r, b, c)),
              ca = sign_of(orientation(q, r, c, a));
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
  }

  /// When J enters the plane of three points; 0 if it is always there: then they are collinear and the meeting is at an
  /// end that stands still.
  Number time_through(const Vector& a, const Vector& b, const Vector& c) const {
    const Number start = orientation(a, b, c, p[0]), end = orientation(a, b, c, p[1]);
    return sign_of(start) == 0 && sign_of(end) == 0 ? Number(0) : Number(start / (start - end));
  }

  /// A hull without volume: u = 0, or J on a line through two other points, or at a point; the first that is a touch.
  std::optional<Number> first_flat() const {
    std::optional<Number> first;
    const auto consider = [&](const Number& u) {
      if (sign_of(u) >= 0 && sign_of(Number(u - 1)) <= 0 && (!first || u < *first) && touches_at(u))
        first = u;
    };
    consider(Number(0));
    const Vector motion = p[1] - p[0];
    const Number length = dot(motion, motion);
    if (sign_of(length) == 0 || first)
      return first;
    for (int i = 2; i < 5; ++i)
      consider(Number(dot(p[i] - p[0], motion) / length));
    const Vector normal = any_normal();
    for (int i = 2; i < 5; ++i)
      for (int j = i + 1; j < 5; ++j) {
        const Vector across = cross(normal, p[j] - p[i]);
        const Number start = dot(across, p[0] - p[i]), end = dot(across, p[1] - p[i]);
        if (sign_of(Number(start - end)) != 0)
          consider(Number(start / (start - end)));
      }
    return first;
  }

  /// A vector normal to the motion and to some other difference of points; zero if all are in line.
  Vector any_normal() const {
    Vector normal = p[0] - p[0];
    const Vector motion = p[1] - p[0];
    for (int i = 2; i < 5 && is_zero(normal); ++i)
      normal = cross(motion, p[i] - p[0]);
    return normal;
  }

  bool touches_at(const Number& u) const {
    const Vector j = p[0] + u * (p[1] - p[0]);
    switch (m_kind) {
    case test::Sweep_kind::vertex_face: return is_in_triangle(j, p[2], p[3], p[4]);
    case test::Sweep_kind::edge_edge: return segments_meet(j, p[2], p[3], p[4]);
    default: return is_in_triangle(p[4], j, p[2], p[3]);
    }
  }

  static bool is_zero(const Vector& a) { return sign_of(a.x) == 0 && sign_of(a.y) == 0 && sign_of(a.z) == 0; }

  static bool is_on_segment(const Vector& q, const Vector& a, const Vector& b) {
    return is_zero(cross(a - q, b - q)) && sign_of(dot(a - q, b - q)) <= 0;
  }

  static bool is_in_triangle(const Vector& q, const Vector& a, const Vector& b, const Vector& c) {
    const Vector normal = cross(b - a, c - a);
    if (is_zero(normal))
      return is_on_segment(q, a, b) || is_on_segment(q, b, c) || is_on_segment(q, c, a);
    return sign_of(dot(normal, q - a)) == 0 && sign_of(dot(normal, cross(b - a, q - a))) >= 0 &&
           sign_of(dot(normal, cross(c - b, q - b))) >= 0 && sign_of(dot(normal, cross(a - c, q - c))) >= 0;
  }

  static bool segments_meet(const Vector& q, const Vector& r, const Vector& a, const Vector& b) {
    if (is_on_segment(q, a, b) || is_on_segment(r, a, b) || is_on_segment(a, q, r) || is_on_segment(b, q, r))
      return true;
    const Vector normal = cross(r - q, b - a);
    if (is_zero(normal) || sign_of(dot(normal, a - q)) != 0)
      return false;
    return sign_of(dot(normal, cross(r - q, a - q))) * sign_of(dot(normal, cross(r - q, b - q))) < 0 &&
           sign_of(dot(normal, cross(b - a, q - a))) * sign_of(dot(normal, cross(b - a, r - a))) < 0;
  }

  test::Sweep_kind m_kind;
  std::array<Vector, 5> p;
};

template <class Number> Sweep_answer determinant_sweep(test::Sweep_kind kind, const test::Sweep_coordinates& x) {
  const std::optional<Number> time = Determinant_sweep<Number>(kind, x)();
  return time ? Sweep_answer{true, as_double(*time)} : Sweep_answer{};
}

} // namespace haptic_sculpt::benchmark
