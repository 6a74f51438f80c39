// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/Sweep_verdict.h>
#include <haptic_sculpt/collision/arithmetic/orientation_filter.h>

#include <variant>

namespace haptic_sculpt::internal {

/// Exact signs among the five points of one sweep, by index. The points become integers once, when the first sign needs
/// it: on degenerate inputs several do.
template <class Counters>
class Sweep_signs {
public:
  Sweep_signs(const Sweep_points& points, Counters& counters) : p_(points), counters_(counters) {}

  Counters& counters() const { return counters_; }

  /// The sign of the determinant of (b - a, c - a, d - a).
  int orientation_3(int a, int b, int c, int d) {
    const Coordinates rb = difference(p_[b], p_[a]), rc = difference(p_[c], p_[a]), rd = difference(p_[d], p_[a]);
    const Enclosed_determinant determinant = enclosed_determinant_3(rb, rc, rd);
    if (determinant.is_certain())
      return determinant.sign();
    int sign = sign_by_permanent(rb, rc, rd, determinant.is_safe);
    if (sign == 0)
      sign = sign_by_short_rows(p_[a], p_[b], p_[c], p_[d]);
    if (sign != 0) {
      counters_.count_permanent();
      return sign;
    }
    return exact([&](const auto& q) { return sign_of(orientation_determinant_3(q[a], q[b], q[c], q[d])); });
  }

  /// The sign of the determinant of (b - a, c - a) in the projection that drops coordinate `axis`.
  int orientation_2(int a, int b, int c, int axis) {
    const Enclosed_determinant determinant = enclosed_orientation_2(p_[a], p_[b], p_[c], axis);
    if (determinant.is_certain())
      return determinant.sign();
    return exact([&](const auto& q) { return sign_of(orientation_determinant_2(q[a], q[b], q[c], axis)); });
  }

private:
  template <class Integer>
  using Integer_points = std::array<std::array<Integer, 3>, 5>;

  const Sweep_points& p_;
  Counters& counters_;
  Exponent_range range_; ///< of all coordinates, as soon as there are integers
  std::variant<std::monostate, Integer_points<Fixed_integer<1>>, Integer_points<Fixed_integer<2>>,
               Integer_points<Fixed_integer<4>>, Integer_points<Big_integer>>
      integers_;

  template <class Sign>
  HAPTIC_SCULPT_NOINLINE int exact(const Sign& sign) {
    const bool is_first = integers_.index() == 0;
    for (std::size_t i = 0; is_first && i < p_.size(); ++i)
      range_.include(p_[i]);
    return with_exact_integers(range_, counters_, [&](auto type) {
      using Points = Integer_points<decltype(type)>;
      if (is_first) {
        Points& q = integers_.template emplace<Points>();
        for (std::size_t i = 0; i < p_.size(); ++i)
          q[i] = to_integers<decltype(type)>(p_[i], range_.lowest);
      }
      return sign(std::get<Points>(integers_));
    });
  }
};

} // namespace haptic_sculpt::internal
