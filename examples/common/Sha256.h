// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nettle/sha2.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace haptic_sculpt::examples {

/// A SHA-256 that is fed piece by piece.
class Sha256 {
public:
  Sha256() { sha256_init(&context_); }

  Sha256& add(std::string_view bytes) {
    sha256_update(&context_, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
    return *this;
  }

  /// 64 hexadecimal digits in lower case. Starts anew.
  std::string digest() {
    std::array<std::uint8_t, SHA256_DIGEST_SIZE> bytes;
    sha256_digest(&context_, bytes.size(), bytes.data());
    std::string text;
    for (std::uint8_t byte : bytes) {
      text += "0123456789abcdef"[byte >> 4];
      text += "0123456789abcdef"[byte & 15];
    }
    return text;
  }

private:
  sha256_ctx context_;
};

inline bool is_sha256(std::string_view word) {
  return word.size() == 64 && word.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

} // namespace haptic_sculpt::examples
