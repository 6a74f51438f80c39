// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Invalid_surface.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace haptic_sculpt::internal {

/// Takes numbers off a sequence of bytes.
class Binary_scanner {
public:
  Binary_scanner(std::string_view bytes, bool big_endian) : rest_(bytes) {
    const std::uint16_t one = 1;
    char first;
    std::memcpy(&first, &one, 1);
    const bool machine_is_big_endian = first == 0;
    swap_ = big_endian != machine_is_big_endian;
  }

  /// \throw Read_error at the end
  template <class Number>
  Number take() {
    if (rest_.size() < sizeof(Number))
      throw Read_error("the file ends within its data");
    std::array<char, sizeof(Number)> bytes;
    std::copy_n(rest_.data(), sizeof(Number), bytes.begin());
    rest_.remove_prefix(sizeof(Number));
    if (swap_)
      std::reverse(bytes.begin(), bytes.end());
    Number value;
    std::memcpy(&value, bytes.data(), sizeof(Number));
    return value;
  }

  std::string_view rest() const { return rest_; }

private:
  std::string_view rest_;
  bool swap_;
};

} // namespace haptic_sculpt::internal
