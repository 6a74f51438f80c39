// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <random>

namespace haptic_sculpt::test {

/// Random numbers that are the same everywhere: the standard fixes std::mt19937_64 but not its distributions.
/// It does not fix the order in which arguments are evaluated either: never draw two of one call's arguments.
class Portable_random {
public:
  explicit Portable_random(std::mt19937_64& engine) : m_engine(engine) {}

  /// A multiple of 2^-53 in [0, 1).
  double unit() { return static_cast<double>(m_engine() >> 11) * 0x1p-53; }
  double real(double low, double high) { return low + (high - low) * unit(); }
  /// An integer of [low, high]; the bias, below 2^-40 here, does not matter.
  int integer(int low, int high) {
    return low + static_cast<int>(m_engine() % static_cast<std::uint64_t>(high - low + 1));
  }
  /// True once in `n`.
  bool one_in(int n) { return integer(1, n) == 1; }
  double sign() { return one_in(2) ? 1 : -1; }

private:
  std::mt19937_64& m_engine;
};

} // namespace haptic_sculpt::test
