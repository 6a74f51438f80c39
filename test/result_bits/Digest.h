// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

namespace haptic_sculpt::result_bits {

/// FNV-1a of 64 bits, of all that it is given, in that order.
class Digest {
public:
  void add(std::uint64_t word) {
    for (int i = 0; i < 8; ++i, word >>= 8)
      sum_ = (sum_ ^ (word & 0xff)) * 0x100000001b3;
  }
  /// All its bits; but what is no number has many, of which none is promised.
  void add(double x) {
    std::uint64_t bits = 0x7ff8000000000000;
    if (x == x)
      std::memcpy(&bits, &x, sizeof bits);
    add(bits);
  }
  void add(bool b) { add(std::uint64_t{b}); }
  void add(int i) { add(static_cast<std::uint64_t>(i)); }
  void add(const std::array<double, 3>& p) {
    for (const double x : p)
      add(x);
  }
  void add(const std::string& text) {
    for (const char c : text)
      add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  }
  std::uint64_t value() const { return sum_; }

private:
  std::uint64_t sum_ = 0xcbf29ce484222325;
};

} // namespace haptic_sculpt::result_bits
