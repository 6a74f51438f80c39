// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_DISTINCT_NUMBERS_H
#define HAPTIC_SCULPT_SCULPTING_DISTINCT_NUMBERS_H

#include <cstdint>
#include <utility>
#include <vector>

namespace haptic_sculpt {
namespace internal {

/// Numbers the distinct ones of a stream of 64-bit numbers in the order in which they come first.
///
/// Open addressing in one array that is kept: made to be filled again and again, hundreds of numbers at a time, without an
/// allocation; a std::unordered_map allocates a node for each. Cost: constant an insertion, expected.
class Distinct_numbers {
public:
  /// Forgets all. \pre no more than `most` insertions follow
  void prepare(std::size_t most) {
    std::size_t size = 64;
    shift_ = 64 - 6;
    while (size < 2 * most)
      size *= 2, --shift_;
    slots_.assign(size, Slot{0, empty});
    count_ = 0;
  }

  /// The position of the number among the distinct ones, and whether it is new.
  std::pair<std::uint32_t, bool> insert(std::uint64_t number) {
    const std::size_t mask = slots_.size() - 1;
    // Multiplicative hashing by 2^64 over the golden ratio (Knuth, The Art of Computer Programming 3, 6.4).
    for (std::size_t i = number * 0x9e3779b97f4a7c15u >> shift_;; i = (i + 1) & mask) {
      if (slots_[i].position == empty) {
        slots_[i] = {number, count_};
        return {count_++, true};
      }
      if (slots_[i].number == number)
        return {slots_[i].position, false};
    }
  }

private:
  static constexpr std::uint32_t empty = ~std::uint32_t{0};
  struct Slot {
    std::uint64_t number;
    std::uint32_t position;
  };
  std::vector<Slot> slots_;
  int shift_ = 0;
  std::uint32_t count_ = 0;
};

} // namespace internal
} // namespace haptic_sculpt

#endif
