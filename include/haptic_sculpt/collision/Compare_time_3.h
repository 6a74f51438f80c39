// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/collision/Impact_3.h>

namespace haptic_sculpt {

/// Which of two impacts comes first; exact, whatever their features and motions.
///
/// Overlapping enclosures are decided in integers: two products of 3x3 determinants.
/// \tparam Mode sets the mode of rounding meanwhile
template <class K, class Counters = No_filter_counters, class Mode = internal::Rounding_to_nearest>
class Compare_time_3 {
public:
  using result_type = CGAL::Comparison_result; ///< of a call, by the name that CGAL's functors give it

  /// \param counters where to count, if anywhere; has to outlive this
  explicit Compare_time_3(Counters* counters = nullptr) : counters_(counters) {}
  /// The same that sets the mode of rounding in another way.
  template <class Other_mode>
  explicit Compare_time_3(const Compare_time_3<K, Counters, Other_mode>& other) : counters_(other.counters()) {}
  Counters* counters() const { return counters_; } ///< where is counted; nullptr: nowhere

  /// `SMALLER` where `a` comes first. Constant cost; allocates only where coordinates need GMP integers.
  result_type operator()(const Impact_3<K>& a, const Impact_3<K>& b) const {
    [[maybe_unused]] const Mode rounding{};
    Counters ignored;
    return static_cast<result_type>(internal::compare_times(a.coordinates(), a.verdict(), b.coordinates(), b.verdict(),
                                                            counters_ != nullptr ? *counters_ : ignored));
  }

private:
  Counters* counters_;
};

} // namespace haptic_sculpt
