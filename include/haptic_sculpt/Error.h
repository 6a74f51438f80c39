// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <stdexcept>
#include <string>

/// Sculpting of closed triangle meshes that never intersect themselves, with exact sweeps, up to the torques of a
/// device.
namespace haptic_sculpt {

/// The base of every exception this library throws. What it says names the offending element and what to do.
///
/// A blocked drag, a refused edit or an unreachable pose is a result, never an exception.
class Error : public std::runtime_error {
public:
  /// \param message what `what()` gives: the offending element, and what to do
  explicit Error(const std::string& message) : std::runtime_error(message) {}
};

namespace internal {

/// A number as messages show it: the shortest decimal that is this number, whatever the locale.
inline std::string number(double x) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

} // namespace internal
} // namespace haptic_sculpt
