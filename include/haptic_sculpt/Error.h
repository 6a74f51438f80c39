// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <locale>
#include <sstream>
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

/// A number as messages show it, with all its digits, whatever the locale.
inline std::string number(double x) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(17);
  out << x;
  return out.str();
}

} // namespace internal
} // namespace haptic_sculpt
