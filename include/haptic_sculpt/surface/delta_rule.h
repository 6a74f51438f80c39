// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/surface/cgal_compatibility.h>

namespace haptic_sculpt {

/// The delta rule of the paper (section 3.1): no altitude of a triangle is below `delta`.
///
/// The least altitude stands on the longest edge, and altitude x edge = |n| for the normal n = (b-a) x (c-a). So the
/// rule is |n|^2 >= delta^2 * (longest edge)^2: a sign of a polynomial of degree 6, decided exactly, by intervals and,
/// where these leave it open, by exact arithmetic on the doubles given.
///
/// \tparam K a CGAL kernel with `FT = double`
template <class K>
class Satisfies_delta_rule_3 {
public:
  using Point_3 = typename K::Point_3; ///< of the kernel; its coordinates are doubles
  using result_type = bool;            ///< of a call, by the name that CGAL's functors give it

  /// \param delta the smallest altitude allowed, in the unit of the coordinates
  /// \pre `delta` is finite and >= 0
  explicit Satisfies_delta_rule_3(double delta = 0) : delta_(delta) {}

  double delta() const { return delta_; } ///< As given: the smallest altitude allowed, in the unit of the coordinates.

  /// Whether all three altitudes of the triangle are at least `delta`. A triangle whose corners lie exactly on a line
  /// never satisfies the rule; for `delta == 0` every other one does.
  /// \pre the coordinates are finite
  bool operator()(const Point_3& a, const Point_3& b, const Point_3& c) const {
    const internal::Rounding_to_nearest rounding; // subnormal numbers count
    return internal::by_intervals_or_exactly([&](auto number) { return decide<decltype(number)>(a, b, c); });
  }

private:
  template <class Number>
  auto decide(const Point_3& a, const Point_3& b, const Point_3& c) const {
    const auto edge = [](const Point_3& p, const Point_3& q) {
      return Vector<Number>{Number(q.x()) - Number(p.x()), Number(q.y()) - Number(p.y()),
                            Number(q.z()) - Number(p.z())};
    };
    const auto ab = edge(a, b), ac = edge(a, c), bc = edge(b, c);
    const Vector<Number> n{ab.y * ac.z - ab.z * ac.y, ab.z * ac.x - ab.x * ac.z, ab.x * ac.y - ab.y * ac.x};
    const Number area = n.squared_length();
    const Number square = CGAL::square(Number(delta_));
    // Every edge is asked, so the longest need not be known. The first term excludes the line for delta = 0.
    return CGAL::make_uncertain(area > Number(0)) & (area >= square * ab.squared_length()) &
           (area >= square * ac.squared_length()) & (area >= square * bc.squared_length());
  }

  template <class Number>
  struct Vector {
    Number x, y, z;
    Number squared_length() const { return CGAL::square(x) + CGAL::square(y) + CGAL::square(z); }
  };

  double delta_;
};

} // namespace haptic_sculpt
