// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace haptic_sculpt::internal {

/// How many pairs may still be decided, counted where a report tells of them (doc/use/work.md, "Many vertices").
class Pair_budget {
public:
  /// \param done counts what is decided; lives as long as this
  Pair_budget(std::size_t limit, std::size_t& done) : limit_(limit), done_(&done) {}

  std::size_t left() const { return limit_ - *done_; }
  /// \pre no more than left()
  void take(std::size_t pairs) { *done_ += pairs; }

private:
  std::size_t limit_;
  std::size_t* done_;
};

} // namespace haptic_sculpt::internal
