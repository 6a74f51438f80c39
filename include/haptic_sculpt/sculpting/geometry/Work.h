// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/exact_integers.h>

#include <limits>

namespace haptic_sculpt::internal {

/// The work of a drag, in pairs decided and candidates looked up, and its bound. Counted, never timed: a replay stops
/// at the same pair (doc/use/work.md).
///
/// Also keeps which trials are due when a drag goes on with a search that another one left. The trials of a search
/// always come in the same order, so their number tells.
class Work {
public:
  static constexpr std::size_t unbounded = std::numeric_limits<std::size_t>::max();

  /// A drag begins; one without a bound begins its search anew, too. \param limit is passed by the pair, or the look at
  /// the broad phase, that ends it
  void begin(std::size_t limit) {
    if (limit != unbounded && is_spent() && trials_ != 0) {
      // The last trial was not finished. Where it alone costs more than the bound the search goes on without it.
      const std::size_t cut = trials_ - 1;
      has_left_out_ = has_left_out_ || cut == last_cut_;
      first_due_ = cut == last_cut_ ? trials_ : cut;
      last_cut_ = cut;
    } else
      begin_search();
    trials_ = 0;
    done_ = 0;
    limit_ = limit;
  }
  /// Nothing is left to go on with.
  void forget() { *this = Work(); }

  void spend(std::size_t amount = 1) { done_ += amount; }
  bool is_bounded() const { return limit_ != unbounded; }
  bool is_spent() const { return done_ > limit_; }
  /// So much may still be spent.
  std::size_t left() const { return is_spent() ? 0 : limit_ - done_; }
  /// No more than the limit: what passed it was not done.
  std::size_t done() const { return is_spent() ? limit_ : done_; }

  /// A search begins, or goes on, with the vertex at rest.
  void search_at(const Coordinates& place) {
    if (place == place_)
      return;
    place_ = place;
    trials_ = 0;
    begin_search();
  }
  /// To be asked once before each trial of a search. False where the last drag has made it, and where the work is
  /// spent.
  bool is_due() {
    if (is_spent())
      return false;
    return trials_++ >= first_due_;
  }
  /// Whether this drag has come to a search.
  bool is_searching() const { return trials_ != 0; }
  /// Whether the search was begun by an earlier drag.
  bool is_resumed() const { return first_due_ != 0; }
  /// Whether it had to leave a trial out, so that nothing is known of what that would have found.
  bool has_left_out() const { return has_left_out_; }

private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  std::size_t done_ = 0, limit_ = unbounded;
  Coordinates place_{};
  std::size_t trials_ = 0, first_due_ = 0, last_cut_ = none;
  bool has_left_out_ = false;

  void begin_search() {
    first_due_ = 0;
    last_cut_ = none;
    has_left_out_ = false;
  }
};

} // namespace haptic_sculpt::internal
