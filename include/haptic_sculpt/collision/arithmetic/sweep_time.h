// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// The time of an impact: u = f(S) / (f(S) - f(T)) for an affine f that vanishes at the impact.
///
/// Along the path f does not change sign before the impact, so f(S) and f(T) have opposite signs (or one is 0), and
/// u = a / (a + b) with a = |f(S)|, b = |f(T)|. See doc/proofs/exact_sweeps.md, "The time of an impact".

#include <haptic_sculpt/collision/arithmetic/Sweep_verdict.h>
#include <haptic_sculpt/collision/arithmetic/unit_of.h>
#include <haptic_sculpt/collision/arithmetic/Wide_double.h>
#include <haptic_sculpt/collision/arithmetic/orientation_filter.h>

#include <gmpxx.h>

#include <utility>

namespace haptic_sculpt::internal {

constexpr double unit_roundoff_any_rounding = 0x1p-52;
/// An enclosure of the time wider than this (absolute, times are in [0, 1]) is computed anew from the exact ratio.
constexpr double widest_filtered_time = 0x1p-40;

inline Enclosed_determinant enclosed_difference(double value) {
  const double magnitude = std::abs(value);
  const double error = unit_roundoff_any_rounding * magnitude; // itself 0 by underflow where the value is not safe
  return {value, error, value == 0 || (magnitude >= least_safe_difference && magnitude <= largest_safe_difference)};
}

/// f at the moving vertex's start (`end == 0`) or target (`end == 1`), in doubles.
inline Enclosed_determinant enclosed_time_function(const Sweep_points& p, const Sweep_verdict& verdict, int end) {
  const auto& through = verdict.through;
  if (verdict.form == Time_form::plane)
    return enclosed_orientation_3(p[through[0]], p[through[1]], p[through[2]], p[end]);
  if (verdict.form == Time_form::line)
    return enclosed_orientation_2(p[through[0]], p[through[1]], p[end], verdict.axis);
  return enclosed_difference(p[end][verdict.axis] - p[through[0]][verdict.axis]);
}

/// The same in another unit. \param unit a power of two, by which differences are multiplied: what underflows then is
/// far less than what is safe
inline Enclosed_determinant enclosed_time_function(const Sweep_points& p, const Sweep_verdict& verdict, int end,
                                                   double unit) {
  const auto& through = verdict.through;
  const auto from = [&](const Coordinates& q) {
    const Coordinates d = difference(q, p[through[0]]);
    return Coordinates{d[0] * unit, d[1] * unit, d[2] * unit};
  };
  if (verdict.form == Time_form::plane)
    return enclosed_determinant_3(from(p[through[1]]), from(p[through[2]]), from(p[end]));
  if (verdict.form == Time_form::line)
    return enclosed_orientation_2(Coordinates{}, from(p[through[1]]), from(p[end]), verdict.axis);
  return enclosed_difference(from(p[end])[verdict.axis]);
}

/// That of the largest difference that the time depends on.
inline double unit_of_differences(const Sweep_points& p, const Sweep_verdict& verdict) {
  const std::size_t others = verdict.form == Time_form::plane ? 2 : verdict.form == Time_form::line ? 1 : 0;
  double largest = 0;
  const auto include = [&](const Coordinates& q) {
    const Coordinates d = difference(q, p[verdict.through[0]]);
    largest = std::max(largest, largest_magnitude(d[0], d[1], d[2]));
  };
  include(p[0]), include(p[1]);
  for (std::size_t i = 1; i <= others; ++i)
    include(p[verdict.through[i]]);
  return unit_of(largest);
}

/// The time as a fraction of non-negative integers. Wide has room for a sum of two 3x3 determinants.
template <class Wide>
struct Time_fraction {
  Wide numerator, denominator;
};

/// The type in which a 3x3 determinant of Integer lives.
template <class Integer>
using Determinant_of = decltype(Integer() * Integer() * Integer());

inline Big_integer promoted(const Big_integer& x, const Big_integer&) { return x; }
template <std::size_t narrow, std::size_t wide>
Fixed_integer<wide> promoted(const Fixed_integer<narrow>& x, const Fixed_integer<wide>&) {
  return widened<wide>(x);
}

template <class Integer>
Time_fraction<Determinant_of<Integer>> exact_time_fraction(const Sweep_points& p, const Sweep_verdict& verdict,
                                                           int lowest) {
  using Wide = Determinant_of<Integer>;
  const auto point = [&](int i) { return to_integers<Integer>(p[i], lowest); };
  const auto one = [&] { return promoted(Integer_of_double<Integer>::convert(1, -52), Wide()); };
  const auto value = [&](int end) -> Wide {
    const auto& through = verdict.through;
    if (verdict.form == Time_form::plane)
      return orientation_determinant_3<Integer>(point(through[0]), point(through[1]), point(through[2]), point(end));
    if (verdict.form == Time_form::line)
      return promoted(
          orientation_determinant_2<Integer>(point(through[0]), point(through[1]), point(end), verdict.axis), Wide());
    return promoted(point(end)[verdict.axis] - point(through[0])[verdict.axis], Wide());
  };
  if (verdict.form == Time_form::at_start)
    return {Wide(), one()};
  const Wide at_start = value(0), at_target = value(1);
  const Wide denominator = at_start - at_target;
  if (sign_of(denominator) < 0)
    return {Wide() - at_start, Wide() - denominator};
  return {at_start, denominator};
}

/// The exponents of all coordinates that the time depends on.
inline Exponent_range time_range(const Sweep_points& p, const Sweep_verdict& verdict) {
  Exponent_range range;
  if (verdict.form == Time_form::at_start)
    return range;
  const std::size_t number_of_static_points = verdict.form == Time_form::plane  ? 3
                                              : verdict.form == Time_form::line ? 2
                                                                                : 1;
  range.include(p[0]), range.include(p[1]);
  for (std::size_t i = 0; i < number_of_static_points; ++i)
    range.include(p[verdict.through[i]]);
  return range;
}

/// The time as a rational in lowest terms. Allocates.
inline mpq_class exact_time(const Sweep_points& p, const Sweep_verdict& verdict) {
  const auto fraction = exact_time_fraction<Big_integer>(p, verdict, time_range(p, verdict).lowest);
  mpq_class time(mpz_class(fraction.numerator.backend().data()), mpz_class(fraction.denominator.backend().data()));
  time.canonicalize();
  return time;
}

/// An interval with double ends that contains the time; the ends are neighbours or equal. Allocates.
inline std::pair<double, double> tight_time(const Sweep_points& p, const Sweep_verdict& verdict) {
  const mpq_class time = exact_time(p, verdict);
  const double below = time.get_d(); // truncates, and times are not negative
  return {below, mpq_class(below) == time ? below : std::nextafter(below, 2.0)};
}

/// An interval that contains the time, from the filter alone; wider than [0, 1] where the filter knows nothing.
inline std::pair<double, double> filtered_time(const Sweep_points& p, const Sweep_verdict& verdict) {
  if (verdict.form == Time_form::at_start)
    return {0, 0};
  Enclosed_determinant start = enclosed_time_function(p, verdict, 0), target = enclosed_time_function(p, verdict, 1);
  if (start.is_safe && start.error == 0)
    return {0, 0};
  if (target.is_safe && target.error == 0)
    return {1, 1};
  if (!(start.is_safe && target.is_safe)) { // in another unit; the time has none
    const double unit = unit_of_differences(p, verdict);
    start = enclosed_time_function(p, verdict, 0, unit), target = enclosed_time_function(p, verdict, 1, unit);
    if (start.error == 0 || target.error == 0) // what is 0 in this unit is not in truth: digits were lost to underflow
      return {-1, 2};
  }
  const double a = std::abs(start.value), sum = a + std::abs(target.value);
  const double error = start.error + target.error;
  if (!(start.is_safe && target.is_safe && sum > 4 * error))
    return {-1, 2};
  // a/(a+b) grows with a and falls with b; errors of one sign in a and the other in b leave the sum within `error`.
  // The four operations below and the sum round by less than 8 units in all.
  const double slack = 8 * unit_roundoff_any_rounding;
  const double lower = (a - error) / (sum + error), upper = (a + error) / (sum - error);
  return {std::max(0.0, lower - slack), std::min(1.0, upper + slack)};
}

/// An interval from the exact fraction, rounded: at most 2^-46 wide relative to the time.
inline std::pair<double, double> time_of_fraction(const Sweep_points& p, const Sweep_verdict& verdict) {
  const Exponent_range range = time_range(p, verdict);
  No_filter_counters uncounted;
  return with_exact_integers(range, uncounted, [&](auto type) -> std::pair<double, double> {
    const auto fraction = exact_time_fraction<decltype(type)>(p, verdict, range.lowest);
    if (sign_of(fraction.numerator) == 0)
      return {0, 0};
    const double time = (Wide_double(fraction.numerator) / Wide_double(fraction.denominator)).to_double();
    // Conversions round twice a limb, of which there are at most twelve in both, and the quotient once; a subnormal
    // quotient by 2^-1074.
    const double slack = 32 * unit_roundoff_any_rounding * time + std::numeric_limits<double>::denorm_min();
    return {std::max(0.0, time - slack), std::min(1.0, time + slack)};
  });
}

inline std::pair<double, double> enclosed_time(const Sweep_points& p, const Sweep_verdict& verdict) {
  const std::pair<double, double> filtered = filtered_time(p, verdict);
  return filtered.second - filtered.first <= widest_filtered_time ? filtered : time_of_fraction(p, verdict);
}

/// Sign of time(first) - time(second), exact.
template <class Counters>
int compare_times(const Sweep_points& p, const Sweep_verdict& first, const Sweep_points& q, const Sweep_verdict& second,
                  Counters& counters) {
  const std::pair<double, double> u = filtered_time(p, first), v = filtered_time(q, second);
  if (u.second < v.first)
    return -1;
  if (u.first > v.second)
    return 1;
  if (u.first == u.second && v == u)
    return 0;
  const Exponent_range p_range = time_range(p, first), q_range = time_range(q, second);
  return with_exact_integers(p_range.spread() > q_range.spread() ? p_range : q_range, counters, [&](auto type) {
    using Integer = decltype(type);
    const auto a = exact_time_fraction<Integer>(p, first, p_range.lowest);
    const auto b = exact_time_fraction<Integer>(q, second, q_range.lowest);
    return sign_of(a.numerator * b.denominator - b.numerator * a.denominator);
  });
}

} // namespace haptic_sculpt::internal
