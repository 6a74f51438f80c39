// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace haptic_sculpt::internal {

/// Numbers the distinct ones of a stream of 64-bit numbers in the order in which they come first.
///
/// Open addressing in one array that is kept: made to be filled again and again, hundreds of numbers at a time, without
/// an allocation and without clearing it; a std::unordered_map allocates a node for each. Cost: constant an insertion,
/// expected.
class Distinct_numbers {
public:
  /// Forgets all. \pre no more than `most` insertions follow
  void prepare(std::size_t most) {
    if (slots_.size() < 2 * most || ++round_ == 0) {
      std::size_t size = 256;
      while (size < 2 * most)
        size *= 2;
      slots_.assign(std::max(size, slots_.size()), Slot{});
      round_ = 1;
    }
    // Few numbers are kept in a small part of the slots, so that they stay in the cache.
    shift_ = 64 - 8;
    mask_ = 255;
    while (mask_ + 1 < 2 * most)
      mask_ = 2 * mask_ + 1, --shift_;
    count_ = 0;
  }

  /// The position of the number among the distinct ones, and whether it is new.
  std::pair<std::uint32_t, bool> insert(std::uint64_t number) {
    // Multiplicative hashing by 2^64 over the golden ratio (Knuth, The Art of Computer Programming 3, 6.4).
    std::size_t i = number * 0x9e3779b97f4a7c15u >> shift_;
    while (slots_[i].round == round_ && slots_[i].number != number)
      i = (i + 1) & mask_;
    Slot& slot = slots_[i];
    const bool is_new = slot.round != round_;
    slot = {number, is_new ? count_ : slot.position, round_};
    count_ += is_new;
    return {slot.position, is_new};
  }

private:
  struct Slot {
    std::uint64_t number = 0;
    std::uint32_t position = 0;
    std::uint32_t round = 0; ///< in which it was filled: those of former rounds count as empty
  };
  std::vector<Slot> slots_;
  std::size_t mask_ = 0;
  int shift_ = 0;
  std::uint32_t round_ = 0, count_ = 0;
};

} // namespace haptic_sculpt::internal
