// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/culling/Distinct_numbers.h>

namespace haptic_sculpt::internal {

/// Tells the distinct ones of a stream of pairs (a, b) of small numbers: the edges of some faces with few vertices.
///
/// A bit for each pair there can be, as long as these are fewer than a cache holds; else a table of those that came.
/// Made to be filled again and again without an allocation. Cost: constant an insertion, expected; n^2 / 64 to forget
/// all.
class Distinct_pairs {
public:
  /// Forgets all. \pre the numbers of the pairs that follow are below n, and no more than `most` insertions follow
  void prepare(std::size_t n, std::size_t most) {
    words_ = n <= most_numbers ? (n + 63) / 64 : 0;
    if (words_ == 0)
      others_.prepare(most);
    else
      bits_.assign(n * words_, 0);
  }

  /// Makes room for this many insertions, whatever the numbers.
  void reserve(std::size_t most) {
    bits_.reserve(most_numbers * (most_numbers / 64));
    others_.prepare(most);
  }

  /// Whether the pair comes for the first time.
  bool insert(std::uint32_t a, std::uint32_t b) {
    if (words_ == 0)
      return others_.insert(std::uint64_t{a} << 32 | b).second;
    std::uint64_t& word = bits_[a * words_ + b / 64];
    const std::uint64_t bit = std::uint64_t{1} << b % 64, before = word;
    word |= bit;
    return (before & bit) == 0;
  }

private:
  static constexpr std::size_t most_numbers = 512; ///< 32 KiB of bits

  std::size_t words_ = 0; ///< of one row of bits
  std::vector<std::uint64_t> bits_;
  Distinct_numbers others_;
};

} // namespace haptic_sculpt::internal
