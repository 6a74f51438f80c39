// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace haptic_sculpt::internal {

/// Which of some small numbers have been met since a round began.
class Round_marks {
public:
  /// Nothing is marked. \param numbers all are smaller. Cost: linear in these the first time, then constant
  void begin(std::size_t numbers) {
    if (round_of_.size() < numbers)
      round_of_.resize(numbers, 0);
    if (++round_ == 0) {
      round_of_.assign(round_of_.size(), 0);
      round_ = 1;
    }
  }
  /// \return whether it was not marked
  bool mark(std::size_t number) {
    const bool is_new = round_of_[number] != round_;
    round_of_[number] = round_;
    return is_new;
  }
  bool is_marked(std::size_t number) const { return round_of_[number] == round_; }
  /// Bytes held, capacity included.
  std::size_t memory() const { return round_of_.capacity() * sizeof(std::uint32_t); }

private:
  std::vector<std::uint32_t> round_of_; ///< in which a number was marked last
  std::uint32_t round_ = 0;
};

} // namespace haptic_sculpt::internal
