// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/Impact_3.h>
#include <haptic_sculpt/collision/arithmetic/Wide_double.h>
#include <haptic_sculpt/collision/arithmetic/Sweep_verdict.h>
#include <haptic_sculpt/sculpting/geometry/vector_3.h>

namespace haptic_sculpt::internal {

/// How a path meets the plane in which the moving vertex is held: A, B, C; V, A, B; or G, I, A.
///
/// Formed from exact determinants and rounded a few times at the end, without cancellation, so it keeps its accuracy on
/// slivers.
struct Path_at_plane {
  double time;   ///< u in [0, 1], within an ulp or two
  double sine;   ///< of the angle between the path and the plane, in [0, 1]; 0 where the plane is not determined
  Vector normal; ///< of length 1, towards the side on which the path began; against the path where not determined
  int side;      ///< the sign of orientation(a, b, c, J) before the impact; 0 where not determined
};

/// The normal of the plane of three points, exact in Integer.
template <class Integer>
Wide_vector wide_normal(const std::array<Integer, 3>& a, const std::array<Integer, 3>& b,
                        const std::array<Integer, 3>& c) {
  const std::array<Integer, 3> p = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const std::array<Integer, 3> q = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  return {Wide_double(p[1] * q[2] - p[2] * q[1]), Wide_double(p[2] * q[0] - p[0] * q[2]),
          Wide_double(p[0] * q[1] - p[1] * q[0])};
}

/// The points of a sweep in units of 2^lowest.
template <class Integer>
std::array<std::array<Integer, 3>, 5> integer_points(const Sweep_points& p, int lowest) {
  const auto point = [&](std::size_t i) { return to_integers<Integer>(p[i], lowest); };
  return {point(0), point(1), point(2), point(3), point(4)};
}

/// The unit vector along v, times sign.
inline Vector unit(const Wide_vector& v, double sign) {
  const Vector m = mantissas(v, common_exponent(v));
  return scaled(normalized(m), sign);
}

/// Of an impact that is not flat. \param points those of the sweep, exact in Integer \param denominator |f(S) - f(T)|,
/// f being the determinant of the plane and J; not 0
template <class Integer>
Path_at_plane path_at_plane(const std::array<std::array<Integer, 3>, 5>& points, double time,
                            const Wide_double& denominator) {
  const auto& [s, t, a, b, c] = points;
  const Wide_vector normal = wide_normal<Integer>(a, b, c);
  const Wide_vector path = {Wide_double(t[0] - s[0]), Wide_double(t[1] - s[1]), Wide_double(t[2] - s[2])};
  // |f(S) - f(T)| = |normal . (T - S)|
  const double sine = (denominator / (length(normal) * length(path))).to_double();
  const int side_of_start = sign_of(orientation_determinant_3<Integer>(a, b, c, s));
  const int side_of_target = sign_of(orientation_determinant_3<Integer>(a, b, c, t));
  const int side = side_of_start != 0 ? side_of_start : -side_of_target;
  return {time, std::fmin(1.0, sine), unit(normal, side), side};
}

/// Of a flat one: there is no plane.
inline Path_at_plane path_at_no_plane(const Coordinates& s, const Coordinates& t, double time) {
  return {time, 0, scaled(normalized(minus(t, s)), -1), 0};
}

/// \pre the impact is one of a path of non-zero length, or is flat.
template <class K>
Path_at_plane path_at_plane(const Impact_3<K>& impact) {
  const Sweep_points& p = impact.coordinates();
  const Sweep_verdict& verdict = impact.verdict();
  const Exponent_range range = time_range(p, verdict);
  No_filter_counters uncounted;
  return with_exact_integers(range, uncounted, [&](auto type) -> Path_at_plane {
    using Integer = decltype(type);
    const auto fraction = exact_time_fraction<Integer>(p, verdict, range.lowest);
    const double time = (Wide_double(fraction.numerator) / Wide_double(fraction.denominator)).to_double();
    if (impact.is_flat())
      return path_at_no_plane(p[0], p[1], time);
    return path_at_plane<Integer>(integer_points<Integer>(p, range.lowest), time, Wide_double(fraction.denominator));
  });
}

/// The same of what other traits have decided, by the time they tell. Where the motion is, in truth, in the plane, or
/// the three points span none, the impact counts as flat.
template <class Impact>
Path_at_plane path_at_plane(const Impact& impact) {
  const Sweep_points p = sweep_points(impact.source(), impact.target(), impact.static_point(0), impact.static_point(1),
                                      impact.static_point(2));
  const auto [earliest, latest] = impact.time();
  const double time = earliest + (latest - earliest) / 2;
  if (impact.is_flat())
    return path_at_no_plane(p[0], p[1], time);
  Exponent_range range;
  for (const Coordinates& point : p)
    range.include(point);
  No_filter_counters uncounted;
  return with_exact_integers(range, uncounted, [&](auto type) -> Path_at_plane {
    using Integer = decltype(type);
    const auto points = integer_points<Integer>(p, range.lowest);
    const auto& [s, t, a, b, c] = points;
    const auto denominator =
        orientation_determinant_3<Integer>(a, b, c, s) - orientation_determinant_3<Integer>(a, b, c, t);
    const int sign = sign_of(denominator);
    if (sign == 0)
      return path_at_no_plane(p[0], p[1], time);
    const Wide_double magnitude =
        sign < 0 ? Wide_double(decltype(denominator)() - denominator) : Wide_double(denominator);
    return path_at_plane<Integer>(points, time, magnitude);
  });
}

/// The distance of q from the contact plane, signed: positive where
/// orientation(a, b, c, q) > 0. Exact up to some roundings at the end, the sign always. 0 where a, b, c are collinear.
inline double height_over_plane(const Coordinates& a, const Coordinates& b, const Coordinates& c,
                                const Coordinates& q) {
  Exponent_range range;
  range.include(a), range.include(b), range.include(c), range.include(q);
  No_filter_counters uncounted;
  return with_exact_integers(range, uncounted, [&](auto type) {
    using Integer = decltype(type);
    const auto point = [&](const Coordinates& p) { return to_integers<Integer>(p, range.lowest); };
    const Wide_double area = length(wide_normal<Integer>(point(a), point(b), point(c)));
    if (area.mantissa == 0)
      return 0.0;
    const Wide_double volume(orientation_determinant_3<Integer>(point(a), point(b), point(c), point(q)));
    return (volume / area * Wide_double(1, range.lowest)).to_double();
  });
}

} // namespace haptic_sculpt::internal
