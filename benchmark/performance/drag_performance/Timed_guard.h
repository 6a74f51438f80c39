// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "drag_performance/Latencies.h"

#include <haptic_sculpt/sculpting/motion/Guarded_star.h>

namespace haptic_sculpt::benchmark {

/// A guard with a stopwatch in front of it, for a response to ask.
template <class Guard>
class Timed_guard {
public:
  using Coordinates = typename Guard::Coordinates;

  explicit Timed_guard(Guard& guard) : guard_(&guard) {}

  double deciding = 0;
  mutable double planes = 0; ///< nanoseconds since reset(): in deciding motions, in forming contact planes and times
  std::size_t motions = 0;         ///< decided since reset()

  void reset() { deciding = planes = 0, motions = 0; }

  const auto& star() const { return guard_->star(); }

  /// A decision whose contacts are timed when they are asked for.
  class Decision {
  public:
    Decision(const typename Guard::Decision& decision, const Timed_guard& guard)
        : decision_(decision), guard_(&guard) {}
    bool is_free() const { return decision_.is_free(); }
    template <class Found>
    double for_each_first_contact(const Found& found) const {
      double time = 0;
      timed(guard_->planes, [&] { time = decision_.for_each_first_contact(found); });
      return time;
    }

  private:
    typename Guard::Decision decision_;
    const Timed_guard* guard_;
  };

  Decision decide(const Coordinates& source, const Coordinates& target, double delta) {
    ++motions;
    const std::uint64_t start = Query_timer::now();
    const auto decision = guard_->decide(source, target, delta);
    deciding += timer().nanoseconds(start, Query_timer::now());
    return Decision(decision, *this);
  }
  bool is_spent() const { return guard_->is_spent(); }
  internal::Work& work() const { return guard_->work(); }
  bool is_free(const Coordinates& source, const Coordinates& target, double delta) {
    ++motions;
    bool free = false;
    timed(deciding, [&] { free = guard_->is_free(source, target, delta); });
    return free;
  }
  template <class Result>
  Coordinates leg(const Coordinates& source, const Coordinates& target, const internal::Drag_rules& rules,
                  Result& result) {
    return guard_->leg(source, target, rules, result);
  }

private:
  Guard* guard_;

  template <class Operation>
  static void timed(double& sum, const Operation& operation) {
    const std::uint64_t start = Query_timer::now();
    operation();
    sum += timer().nanoseconds(start, Query_timer::now());
  }
};

} // namespace haptic_sculpt::benchmark
