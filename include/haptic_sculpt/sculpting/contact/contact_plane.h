// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_CONTACT_PLANE_H
#define HAPTIC_SCULPT_SCULPTING_CONTACT_PLANE_H

#include <haptic_sculpt/collision/Impact_3.h>
#include <haptic_sculpt/collision/arithmetic/Wide_double.h>
#include <haptic_sculpt/sculpting/motion/vector_3.h>

namespace haptic_sculpt {
namespace internal {

/// How a path meets the plane in which the moving vertex is held: A, B, C; V, A, B; or G, I, A.
///
/// Formed from exact determinants and rounded once at the end, so it keeps its accuracy on slivers.
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

/// The unit vector along v, times sign.
inline Vector unit(const Wide_vector& v, double sign) {
  const Vector m = mantissas(v, common_exponent(v));
  return scaled(normalized(m), sign);
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
      return {time, 0, scaled(normalized(minus(p[1], p[0])), -1), 0};
    const auto point = [&](int i) { return to_integers<Integer>(p[i], range.lowest); };
    const auto s = point(0), t = point(1), a = point(2), b = point(3), c = point(4);
    const Wide_vector normal = wide_normal<Integer>(a, b, c);
    const Wide_vector path = {Wide_double(t[0] - s[0]), Wide_double(t[1] - s[1]), Wide_double(t[2] - s[2])};
    // |f(S) - f(T)| = |normal . (T - S)|
    const double sine = (Wide_double(fraction.denominator) / (length(normal) * length(path))).to_double();
    const int side_of_start = sign_of(orientation_determinant_3<Integer>(a, b, c, s));
    const int side_of_target = sign_of(orientation_determinant_3<Integer>(a, b, c, t));
    const int side = side_of_start != 0 ? side_of_start : -side_of_target;
    return {time, std::fmin(1.0, sine), unit(normal, side), side};
  });
}

/// The distance of q from the contact plane, signed: positive where
/// orientation(a, b, c, q) > 0. Exact up to one rounding. 0 where a, b, c are collinear.
inline double height_over_plane(const Coordinates& a, const Coordinates& b, const Coordinates& c, const Coordinates& q) {
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

} // namespace internal
} // namespace haptic_sculpt

#endif
