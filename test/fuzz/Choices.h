// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>

namespace haptic_sculpt::fuzz {

/// Choices read from the bytes of an input, one after the other. Behind the end all are 0.
class Choices {
public:
  Choices(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}

  bool at_end() const { return at_ == end_; }
  std::uint8_t byte() { return at_end() ? 0 : *at_++; }
  /// \pre 0 < n <= 256
  std::size_t below(std::size_t n) { return byte() % n; }
  bool flag() { return byte() & 1; }

  template <class Integer>
  Integer integer() {
    Integer value = 0;
    for (std::size_t i = 0; i < sizeof value; ++i)
      value = static_cast<Integer>(value << 8 | byte());
    return value;
  }

  /// Any double, those that are no numbers among them.
  double any_double() {
    const auto bits = integer<std::uint64_t>();
    double x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
  }

  /// Mostly a multiple of a quarter, or what is beside one, about what meshes of size 1 to 2 are made of; now and then
  /// any double.
  double number() {
    switch (below(8)) {
    case 0:
      return any_double();
    case 1:
      return std::nextafter(grid(), flag() ? 8 : -8);
    case 2:
      return std::ldexp(1.0, static_cast<int>(below(64)) - 60);
    case 3:
    case 4:
      return static_cast<double>(integer<std::int16_t>()) / 8192;
    default:
      return grid();
    }
  }

private:
  const std::uint8_t *at_, *end_;

  double grid() { return static_cast<double>(static_cast<int>(below(17)) - 6) / 4; }
};

/// Bytes to choose by.
inline std::string random_bytes(std::mt19937_64& random, std::size_t most) {
  std::string bytes(1 + random() % most, '\0');
  for (char& byte : bytes)
    byte = static_cast<char>(random());
  return bytes;
}

} // namespace haptic_sculpt::fuzz
