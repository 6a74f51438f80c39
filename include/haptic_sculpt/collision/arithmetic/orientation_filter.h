// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Exact signs of orientation determinants of doubles: a semi-static filter, then integers.
///
/// The bounds are derived in doc/proofs/sweep_arithmetic.md, "The floating-point filter". They hold in every rounding
/// mode, with and without contraction to fused multiply-add.

#include <haptic_sculpt/collision/Filter_counters.h>
#include <haptic_sculpt/collision/arithmetic/exact_integers.h>
#include <haptic_sculpt/collision/arithmetic/floating_point_contract.h>

#include <algorithm>
#include <cmath>

/// \cond internal
#if defined(__GNUC__)
#define HAPTIC_SCULPT_NOINLINE __attribute__((noinline)) // keeps what stands before it small enough to inline
#define HAPTIC_SCULPT_ALWAYS_INLINE inline __attribute__((always_inline)) // GCC calls what is used in a few places
#else
#define HAPTIC_SCULPT_NOINLINE
#define HAPTIC_SCULPT_ALWAYS_INLINE inline
#endif
/// \endcond

namespace haptic_sculpt::internal {

/// |computed 3x3 determinant - exact| <= this times the product of the largest differences in x, y and z.
/// The derivation gives 54 units of 2^-52; the rest covers the rounding of the product itself.
constexpr double orientation_3_error = 0x1p-46;
/// The same for the 2x2 determinant: 10.1 units of 2^-52 from the derivation; this is 16.
constexpr double orientation_2_error = 0x1p-48;
/// While the largest differences in x, y and z all stay between these, neither overflow nor underflow reaches the
/// bound.
constexpr double least_safe_difference = 0x1p-300;
constexpr double largest_safe_difference = 0x1p+300;

/// A determinant rounded to double, and how far the exact one can be from it.
struct Enclosed_determinant {
  double value;
  double error; ///< 0 only where the determinant is exactly 0
  bool is_safe; ///< nothing overflowed or underflowed: `error` holds; otherwise nothing is known

  /// Whether the sign of `value` is that of the exact determinant.
  bool is_certain() const { return is_safe && (std::abs(value) > error || error == 0); }
  /// Whether the exact determinant is certainly not 0. Without a branch.
  bool is_nonzero() const { return is_safe & (std::abs(value) > error); }
  int sign() const { return (value > 0) - (value < 0); }
};

inline double largest_magnitude(double a, double b, double c) {
  a = std::abs(a), b = std::abs(b), c = std::abs(c);
  const double d = a < b ? b : a;
  return d < c ? c : d;
}

/// The 3x3 determinant of rows b, c, d of differences.
HAPTIC_SCULPT_ALWAYS_INLINE Enclosed_determinant enclosed_determinant_3(const Coordinates& b, const Coordinates& c,
                                                                        const Coordinates& d) {
  const double mx = largest_magnitude(b[0], c[0], d[0]);
  const double my = largest_magnitude(b[1], c[1], d[1]);
  const double mz = largest_magnitude(b[2], c[2], d[2]);
  const double least = std::min(mx, std::min(my, mz)), largest = std::max(mx, std::max(my, mz));
  // A column is exactly zero, because a difference is zero only between equal doubles: so is the determinant.
  if (least == 0)
    return {0, 0, true};
  const double value =
      (b[0] * c[1] - b[1] * c[0]) * d[2] + (b[1] * c[2] - b[2] * c[1]) * d[0] + (b[2] * c[0] - b[0] * c[2]) * d[1];
  return {value, orientation_3_error * (mx * my * mz),
          least >= least_safe_difference && largest <= largest_safe_difference};
}

inline Coordinates difference(const Coordinates& p, const Coordinates& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

inline Enclosed_determinant enclosed_orientation_3(const Coordinates& a, const Coordinates& b, const Coordinates& c,
                                                   const Coordinates& d) {
  return enclosed_determinant_3(difference(b, a), difference(c, a), difference(d, a));
}

/// The 2x2 determinant of rows b, c of differences.
HAPTIC_SCULPT_ALWAYS_INLINE Enclosed_determinant enclosed_determinant_2(double bi, double bj, double ci, double cj) {
  const double mi = std::max(std::abs(bi), std::abs(ci)), mj = std::max(std::abs(bj), std::abs(cj));
  const double least = std::min(mi, mj), largest = std::max(mi, mj);
  if (least == 0)
    return {0, 0, true};
  return {bi * cj - bj * ci, orientation_2_error * (mi * mj),
          least >= least_safe_difference && largest <= largest_safe_difference};
}

inline Enclosed_determinant enclosed_orientation_2(const Coordinates& a, const Coordinates& b, const Coordinates& c,
                                                   int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  return enclosed_determinant_2(b[i] - a[i], b[j] - a[j], c[i] - a[i], c[j] - a[j]);
}

/// The second stage of the filter: |computed - exact| <= this times the sum of the magnitudes of all six products,
/// which is far less than six times the largest possible one where coordinates differ in size. 9 units of 2^-52 each;
/// this is 32.
constexpr double permanent_error = 0x1p-47;
/// What underflow can add in the second stage: six products that err by 2^-1074, times a third factor of at most 2^300,
/// with room.
constexpr double permanent_underflow = 0x1p-760;
/// The same after scaling: entries err by 2^-1074, which scaling a column up multiplies by at most 2^500, with room.
constexpr double scaled_permanent_underflow = 0x1p-540;
/// A column that is smaller than this once the rows are of size 1 is not scaled up: it may have lost digits to
/// underflow.
constexpr double least_scaled_column = 0x1p-500;

/// Scales three entries by a power of two so that the largest is in [1, 2), and says whether it could: not where they
/// have overflowed or none is as large as `least`.
inline bool scale_to_one(double& a, double& b, double& c, double least) {
  const double m = largest_magnitude(a, b, c);
  if (!(m >= least) || !std::isfinite(m))
    return false;
  const int exponent = std::ilogb(m);
  a = std::ldexp(a, -exponent), b = std::ldexp(b, -exponent), c = std::ldexp(c, -exponent);
  return true;
}

/// The sign of the determinant of three rows of differences, or 0 where this stage does not know.
/// \param is_safe whether the differences are in the range in which nothing over- or underflows
inline int sign_by_permanent(Coordinates b, Coordinates c, Coordinates d, bool is_safe) {
  if (!is_safe) {
    // Powers of two on rows and columns keep the sign.
    for (Coordinates* row : {&b, &c, &d})
      if (!scale_to_one((*row)[0], (*row)[1], (*row)[2], std::numeric_limits<double>::denorm_min()))
        return 0;
    for (int axis = 0; axis < 3; ++axis)
      if (!scale_to_one(b[axis], c[axis], d[axis], least_scaled_column))
        return 0;
  }
  const double bc = b[0] * c[1], cb = b[1] * c[0], cd = b[1] * c[2], dc = b[2] * c[1], db = b[2] * c[0],
               bd = b[0] * c[2];
  const double value = (bc - cb) * d[2] + (cd - dc) * d[0] + (db - bd) * d[1];
  const double permanent = (std::abs(bc) + std::abs(cb)) * std::abs(d[2]) +
                           (std::abs(cd) + std::abs(dc)) * std::abs(d[0]) +
                           (std::abs(db) + std::abs(bd)) * std::abs(d[1]);
  const double error = permanent_error * permanent + (is_safe ? permanent_underflow : scaled_permanent_underflow);
  return (value > error) - (value < -error);
}

/// The same of the determinant of (b - a, c - a, d - a) from rows that are as short as may be: from d, and b's from a
/// where that is nearer. Far from the still points, where a drag to a far target leads, the moving one's two places are
/// a, b, or one of them; rows that are all from there are all but parallel, and as long as it is far.
inline int sign_by_short_rows(const Coordinates& a, const Coordinates& b, const Coordinates& c, const Coordinates& d) {
  const auto size = [](const Coordinates& row) { return largest_magnitude(row[0], row[1], row[2]); };
  const Coordinates of_a = difference(a, d), of_c = difference(c, d), from_a = difference(b, a),
                    from_d = difference(b, d);
  const Coordinates& of_b = size(from_a) < size(from_d) ? from_a : from_d;
  return -sign_by_permanent(of_a, of_b, of_c, enclosed_determinant_3(of_a, of_b, of_c).is_safe);
}

template <class Counters>
int exact_orientation_3(const Coordinates& a, const Coordinates& b, const Coordinates& c, const Coordinates& d,
                        Counters& counters) {
  Exponent_range range;
  range.include(a), range.include(b), range.include(c), range.include(d);
  return with_exact_integers(range, counters, [&](auto type) {
    using Integer = decltype(type);
    const auto integer = [&](const Coordinates& p) { return to_integers<Integer>(p, range.lowest); };
    return sign_of(orientation_determinant_3<Integer>(integer(a), integer(b), integer(c), integer(d)));
  });
}

template <class Counters>
HAPTIC_SCULPT_NOINLINE int orientation_3_past_the_filter(const Coordinates& a, const Coordinates& b,
                                                         const Coordinates& c, const Coordinates& d,
                                                         bool first_stage_was_safe, Counters& counters) {
  const int sign = sign_by_permanent(difference(b, a), difference(c, a), difference(d, a), first_stage_was_safe);
  if (sign != 0) {
    counters.count_permanent();
    return sign;
  }
  return exact_orientation_3(a, b, c, d, counters);
}

/// Sign of the determinant of (b - a, c - a, d - a): 1 where d sees a, b, c clockwise from the side opposite to the
/// triangle's normal, that is on the positive side of the plane, as CGAL::orientation(a, b, c, d).
template <class Counters>
int orientation_3(const Coordinates& a, const Coordinates& b, const Coordinates& c, const Coordinates& d,
                  Counters& counters) {
  const Enclosed_determinant determinant = enclosed_orientation_3(a, b, c, d);
  return determinant.is_certain() ? determinant.sign()
                                  : orientation_3_past_the_filter(a, b, c, d, determinant.is_safe, counters);
}

template <class Counters>
HAPTIC_SCULPT_NOINLINE int exact_orientation_2(const Coordinates& a, const Coordinates& b, const Coordinates& c,
                                               int axis, Counters& counters) {
  Exponent_range range;
  for (const Coordinates* p : {&a, &b, &c})
    range.include((*p)[(axis + 1) % 3]), range.include((*p)[(axis + 2) % 3]);
  return with_exact_integers(range, counters, [&](auto type) {
    using Integer = decltype(type);
    // The dropped coordinate may not fit and is not needed.
    const auto integer = [&](Coordinates p) {
      p[axis] = 0;
      return to_integers<Integer>(p, range.lowest);
    };
    return sign_of(orientation_determinant_2<Integer>(integer(a), integer(b), integer(c), axis));
  });
}

/// Sign of the determinant of (b - a, c - a) in the projection that drops coordinate `axis`.
template <class Counters>
int orientation_2(const Coordinates& a, const Coordinates& b, const Coordinates& c, int axis, Counters& counters) {
  const Enclosed_determinant determinant = enclosed_orientation_2(a, b, c, axis);
  return determinant.is_certain() ? determinant.sign() : exact_orientation_2(a, b, c, axis, counters);
}

} // namespace haptic_sculpt::internal
