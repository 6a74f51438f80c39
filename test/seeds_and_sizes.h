// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <string>

/// \file
/// What `test/seeds` sets: the seed of a randomised test, and the share of its size.

namespace haptic_sculpt::test {

/// \throw std::runtime_error for what is no whole number, such as 1e9
inline std::uint64_t whole_number_in_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  if (text == nullptr)
    return otherwise;
  const char* const end = text + std::strlen(text);
  std::uint64_t value = 0;
  if (const auto read = std::from_chars(text, end, value); read.ec != std::errc() || read.ptr != end)
    throw std::runtime_error(std::string(name) + " must be a whole number, not '" + text + "'");
  return value;
}

inline std::uint64_t seed_from_environment(std::uint64_t otherwise) {
  const std::uint64_t seed = whole_number_in_environment("HAPTIC_SCULPT_SEED", otherwise);
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
  const auto share = static_cast<std::size_t>(share_of_sizes() * static_cast<double>(otherwise));
  return static_cast<std::size_t>(whole_number_in_environment(name, share > 0 ? share : 1));
}

} // namespace haptic_sculpt::test
