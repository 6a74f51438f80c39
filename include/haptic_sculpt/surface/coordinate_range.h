// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>

#include <array>
#include <cmath>
#include <string>

namespace haptic_sculpt {

/// The largest magnitude of a coordinate, clearance or delta for which everything is proven: 2^1000, about 1.07e301.
/// There is no least one: zero and subnormal numbers are ordinary.
///
/// Differences of coordinates, sums of some of them and their small multiples then stay below 2^1023, so none overflows
/// on the way to what leaves pairs out (doc/proofs/sweep_arithmetic.md, "The range of coordinates").
constexpr double largest_coordinate = 0x1p1000;

/// A coordinate or a length that is larger than `largest_coordinate`, or not a number, was given. Nothing has changed.
class Out_of_range : public Error {
public:
  using Error::Error; ///< takes the message that `what()` gives
};

/// Whether a coordinate or a length may be given: false for what is not a number, too.
inline bool is_in_range(double x) { return std::abs(x) <= largest_coordinate; }
/// The same of three coordinates.
inline bool is_in_range(const std::array<double, 3>& p) {
  return is_in_range(p[0]) && is_in_range(p[1]) && is_in_range(p[2]);
}

namespace internal {

/// \throw Out_of_range always. \param what names the point, e.g. "the target"
[[noreturn]] inline void throw_out_of_range(const std::string& what, const std::array<double, 3>& p) {
  throw Out_of_range(what + " (" + number(p[0]) + ", " + number(p[1]) + ", " + number(p[2]) +
                     ") is out of range: give three coordinates of at most 2^1000, about 1.07e301");
}

/// \throw Out_of_range unless a length may be used.
inline void check_range(const char* what, double length) {
  if (!is_in_range(length))
    throw Out_of_range(std::string(what) + " " + number(length) +
                       " is out of range: give a length of at most 2^1000, about 1.07e301");
}

} // namespace internal
} // namespace haptic_sculpt
