// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstdlib>
#include <iostream>

/// \file
/// What `test/seeds` sets: the seed of a randomised test, and the share of its size.

namespace haptic_sculpt::test {

inline std::uint64_t seed_from_environment(std::uint64_t otherwise) {
  const char* text = std::getenv("HAPTIC_SCULPT_SEED");
  const std::uint64_t seed = text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
  std::cout << "seed " << seed << '\n';
  return seed;
}

/// The share of their sizes with which tests are to run: 1, unless `test/seeds` says less.
inline double share_of_sizes() {
  const char* text = std::getenv("HAPTIC_SCULPT_SHARE");
  return text != nullptr ? std::strtod(text, nullptr) : 1;
}

/// Whether a population was met more than `least` times: asked of runs of full size only.
inline bool is_enough(std::size_t times, std::size_t least) { return share_of_sizes() < 1 || times > least; }

inline std::size_t count_from_environment(const char* name, std::size_t otherwise) {
  const char* text = std::getenv(name);
  const auto share = static_cast<std::size_t>(share_of_sizes() * static_cast<double>(otherwise));
  return text != nullptr ? std::strtoull(text, nullptr, 10) : share > 0 ? share : 1;
}

} // namespace haptic_sculpt::test
