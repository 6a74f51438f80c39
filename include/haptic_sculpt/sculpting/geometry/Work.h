// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>

namespace haptic_sculpt::internal {

/// The work of a drag, in pairs decided and candidates looked up, and its bound. Counted, never timed: a replay stops
/// at the same pair (doc/use/work.md).
class Work {
public:
  static constexpr std::size_t unbounded = std::numeric_limits<std::size_t>::max();

  /// A drag begins. \param limit is passed by the pair, or the look at the broad phase, that ends it
  void begin(std::size_t limit) {
    done_ = 0;
    limit_ = limit;
  }

  void spend(std::size_t amount = 1) { done_ += amount; }
  bool is_bounded() const { return limit_ != unbounded; }
  bool is_spent() const { return done_ > limit_; }
  /// So much may still be spent.
  std::size_t left() const { return is_spent() ? 0 : limit_ - done_; }
  /// No more than the limit: what passed it was not done.
  std::size_t done() const { return is_spent() ? limit_ : done_; }

private:
  std::size_t done_ = 0, limit_ = unbounded;
};

} // namespace haptic_sculpt::internal
